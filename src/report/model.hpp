#pragma once
// The discrete physical model of a scene in fp64 and SI units: what the references solve and what the
// errors of measure are weighed by. Written for the reader; shares nothing with kernels or world, and
// with the plan only the formulas of plan/material.hpp and the mesh's edges and hinges.

#include "taut/elements/element.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/plate_hinges.hpp"
#include "taut/plan/solid.hpp"
#include "taut/plan/surface.hpp"
#include "taut/report/gas.hpp"
#include "taut/scene/scene.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// A vertex whose place is prescribed.
struct ModelPin
{
    std::uint32_t vertex = 0;
    std::vector<Keyframe> motion; ///< pose() of `start`; empty = held
};

/// An element of Body::elements: what is known of it is its energy, and its stretch where its kind has one.
struct AddedElement
{
    const ElementKind* kind = nullptr;
    std::array<std::uint32_t, 4> vertex{}; ///< the first kind->corners
    std::vector<double> values;

    double energy(std::span<const glm::dvec3> x) const; ///< J
    /// N on its corners, by central differences of the energy over 1e-5 of its size: to about nine digits.
    std::array<glm::dvec3, 4> forces(std::span<const glm::dvec3> x) const;
    /// ElementKind::stretches, or nothing at all.
    std::optional<std::array<double, 2>> stretches(std::span<const glm::dvec3> x) const;
};

/// Vertices are scene-wide: bodies one after another, as in their meshes.
struct PhysicalModel
{
    std::vector<double> mass;                 ///< kg, > 0, of pinned vertices too
    std::vector<double> gap;                  ///< m kept from colliders
    std::vector<bool> pinned;
    std::vector<bool> weightless; ///< of a kinematic body, whose mass nobody gave
    std::vector<bool> flows; ///< of a plastic body, of which the elements below are as at the start
    std::vector<glm::dvec3> start;            ///< m
    std::vector<glm::dvec3> velocity;         ///< m/s; 0 where pinned
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<PlateHinge> plates;           ///< hinges of plates; none of them is in `hinges`
    std::vector<VolumeElement> volumes;       ///< tetrahedra whose volume is held
    std::vector<SolidElement> solids;         ///< elastic tetrahedra
    std::vector<SurfaceElement> surfaces;     ///< whose volume within is held
    std::vector<GasElement> gases;            ///< within closed surfaces
    std::vector<AddedElement> added;          ///< of Body::elements: membranes, and what a program added
    std::size_t dropped_hinges = 0;           ///< without an angle at rest
    std::vector<ModelPin> pins;               ///< ascending, one a vertex
    std::vector<Collider> colliders;
    bool faces_meet = false; ///< a collider pushes triangles (scene/faces.hpp): references do not follow
    std::vector<std::uint32_t> body_start;    ///< first vertex of each body, and the total
    glm::dvec3 gravity{0};                    ///< m/s^2
    double damping = 0;                       ///< 1/s
    double max_speed = 0;                     ///< m/s, 0 = none
    double timestep = 0, duration = 0;        ///< s
    double diameter = 0;                      ///< m, diagonal of the box of all rest positions
};

PhysicalModel make_model(const Scene& resolved);
/// PhysicalModel::diameter.
double rest_diameter(const Scene& resolved);

/// Those of Body::elements, its first vertex being `first`. All kinds must be known: make_plan() refuses
/// others.
std::vector<AddedElement> body_elements(const Body& resolved, std::uint32_t first);

/// Those of all bodies, vertices scene-wide.
std::vector<AddedElement> scene_elements(const Scene& resolved);

/// rad, from the rest angle; 0 where a wing has no area.
double bend_angle(const BendElement& element, std::span<const glm::dvec3> x);

/// J. Rigid elements (compliance 0) have no energy: they count as infinite when they are not at rest
/// length, so only call it on models without them.
double elastic_energy(const PhysicalModel& model, std::span<const glm::dvec3> x);
/// J, the part of hinges and plates.
double bending_energy(const PhysicalModel& model, std::span<const glm::dvec3> x);
/// J, 0 at the origin; without what is weightless.
double gravity_energy(const PhysicalModel& model, std::span<const glm::dvec3> x);
/// J, of all gases (gas.hpp).
double gas_energy(const PhysicalModel& model, std::span<const glm::dvec3> x);
/// N: elastic forces of compliant elements, gases and gravity. Rigid elements are left out. Pins included.
void add_forces(const PhysicalModel& model, std::span<const glm::dvec3> x, std::vector<glm::dvec3>& out);

/// N: adds the sizes of the forces that every element and gravity have on each vertex.
void add_force_sizes(const PhysicalModel& model, std::span<const glm::dvec3> x, std::vector<double>& out);

/// N, mass times gravity of the vertices that move.
double total_weight(const PhysicalModel& model);
std::size_t rigid_element_count(const PhysicalModel& model);

/// By how much stiffer than at `x` tetrahedra and enclosed volumes count in frequency_bound: room for what a
/// deformation adds to them.
inline constexpr double kStiffening = 2;

/// Bound on the eigenfrequencies that a state near `x` can have, 1/s: the square root of the largest row sum
/// of |M^-1 K| (Gershgorin, by blocks of 3 x 3). Springs count at their stiffest, hinges as at `x`,
/// tetrahedra, enclosed volumes and gases kStiffening times as at `x`. 0 without elements.
double frequency_bound(const PhysicalModel& model, std::span<const glm::dvec3> x);

/// What one evaluation of all forces costs, in springs.
std::size_t element_cost(const PhysicalModel& model);

} // namespace taut
