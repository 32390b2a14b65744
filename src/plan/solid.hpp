#pragma once
// Solids of tetrahedra: material and rest shape into numbers per tetrahedron, and their energies in fp64.
// The plan and the references of src/report both call this, as they do material.hpp.
//
// Based on: Smith, de Goes, Kim. Stable Neo-Hookean Flesh Simulation. ACM TOG 37(2), 2018: eq. 13 (with the
//   logarithm) and 16 to 18.
// Departures: the model "neo_hookean_simple" leaves the logarithm out; a body without it has a second stable
//   state, collapsed to a point.

#include "taut/scene/scene.hpp"

#include <glm/mat3x3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// E = (V - rest_volume)^2 / (2 compliance), V the signed volume. Vertices of the body's own mesh.
struct VolumeElement
{
    std::array<std::uint32_t, 4> vertex{};
    double rest_volume = 0; ///< m^3, > 0
    double compliance = 0;  ///< m^6/J, >= 0; 0 = rigid
};

/// E = rest_volume (mu/2 (I - 3) - log mu/2 ln(I + 1) + lambda/2 (J - rest)^2) with F = (edges) inverse_rest,
/// I = |F|^2, J = det F; zero force at F = 1.
struct SolidElement
{
    std::array<std::uint32_t, 4> vertex{};
    glm::dmat3 inverse_rest{1}; ///< 1/m, of the matrix with the columns x_k - x_0
    double rest_volume = 0;     ///< m^3, > 0
    double mu = 0, lambda = 0;  ///< Pa: of this energy, not Lame's
    double rest = 1;            ///< J at which the second term vanishes
    double log = 1;             ///< 1 with the logarithm, 0 without
};

/// Tetrahedra of a resolved body whose volumes are held beside springs, in the order of the mesh; none unless
/// holds_volumes.
std::vector<VolumeElement> volume_elements(const Body& body);
bool holds_volumes(const Body& body);

/// Tetrahedra of a resolved body that are elastic by themselves (the neo-Hookean models); none unless
/// is_elastic.
std::vector<SolidElement> solid_elements(const Body& body);
bool is_elastic(const Body& body);

/// The same energies as volume_elements, as elements without shear stiffness: lambda/2 (J - 1)^2 per volume.
/// Infinite lambda = rigid.
std::vector<SolidElement> volume_solids(const Body& body);

/// Pa: the modulus by which a body holds volumes; infinite = rigid, 0 = not at all.
double bulk_modulus(const Material& material);

/// m^3, signed.
double volume_of(const std::array<std::uint32_t, 4>& vertex, std::span<const glm::dvec3> x);
/// m^2: how that changes with each corner.
std::array<glm::dvec3, 4> volume_gradient(const std::array<std::uint32_t, 4>& vertex,
                                          std::span<const glm::dvec3> x);

/// Columns x_k - x_0 times inverse_rest.
glm::dmat3 deformation(const SolidElement& element, std::span<const glm::dvec3> x);
/// J, 0 at rest.
double solid_energy(const SolidElement& element, std::span<const glm::dvec3> x);
/// N: the negative gradient of solid_energy by each corner.
std::array<glm::dvec3, 4> solid_forces(const SolidElement& element, std::span<const glm::dvec3> x);

} // namespace taut
