#pragma once
// From materials to masses and springs: the one place that turns continuum values (density, membrane
// modulus, plate rigidity) into numbers per vertex, edge and hinge. The plan and the references of
// src/report both call this, so that an error of measure compares solvers and never two discretisations.

#include "taut/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace taut {

/// E = 1/2 (|x_a - x_b| - rest_length)^2 / compliance. Vertices of the body's own mesh.
struct StretchElement
{
    std::uint32_t a = 0, b = 0;
    double rest_length = 0; ///< m, >= 0
    double compliance = 0;  ///< m/N, >= 0; 0 = rigid
    SpringKind kind = SpringKind::structural;
    double damping = 0; ///< N s/m, >= 0: force -damping * (relative speed along the spring); 0 where rigid
};

/// E = 1/2 (theta - rest_angle)^2 / compliance, theta = dihedral_angle(edge0, edge1, wing0, wing1).
struct BendElement
{
    std::uint32_t edge0 = 0, edge1 = 0, wing0 = 0, wing1 = 0;
    double rest_angle = 0; ///< rad, (-pi, pi]
    double compliance = 0; ///< rad^2/J, >= 0; 0 = rigid
};

/// kg per vertex of a resolved body, all > 0: a quarter of every tetrahedron at it; of bodies without
/// tetrahedra a third of every triangle at it, half of every link at it (a strip of link_width). A vertex
/// that gets nothing this way has the mean of the others; a body in which no vertex gets anything (a free
/// particle) has density * shape.length * shape.width at each. Body::vertex_masses, when given, stands
/// instead.
std::vector<double> vertex_masses(const Body& body);

/// Springs of a resolved body: mesh edges by (a, b), then links, then Body::springs, each in its order.
/// Of a solid with the model "springs": all edges of its tetrahedra, of a material with the modulus E.
/// Of others empty of mesh edges and links when stretch_stiffness is 0 or the grid has a network; rigid
/// (compliance 0) when it is inf. Edges beside no area carry no load and are left out; edges of zero length
/// stay, rigid.
std::vector<StretchElement> stretch_elements(const Body& body);
/// Whether there may be any.
bool has_springs(const Body& body);

/// Hinges of a resolved body in the order of mesh_hinges; none when nothing resists bending. Hinges with a
/// zero edge or a zero-area triangle at rest have no angle: left out, and counted in `dropped`. Of a plate
/// those of plate_hinges(), whose energy is a bound from above.
std::vector<BendElement> bend_elements(const Body& body, std::size_t* dropped = nullptr);

/// Signed angle between two triangles at the edge x0-x1 with wings x2 and x3: 0 when flat, in (-pi, pi].
/// 0 when the edge or both triangles vanish.
double dihedral_angle(const glm::dvec3& x0, const glm::dvec3& x1, const glm::dvec3& x2, const glm::dvec3& x3);

} // namespace taut
