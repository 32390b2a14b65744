#pragma once
// Internal to src/scene: the membrane of a fabric, a triangle of constant strain for each of a body's.

#include "taut/scene/checker.hpp"
#include "taut/scene/scene.hpp"

#include <array>

namespace taut::scene_file {

/// Name of the element, the stem of kernels/elements/membrane.glsl.
inline constexpr const char* kMembrane = "membrane";

/// What the element has of one triangle (m, at rest) for a warp along `grain`: P by rows, 1/m, then C times
/// the area, J. P is the inverse of the matrix whose columns are the edges from corner 0 in coordinates along
/// warp and weft. Not finite for triangles without area and where the grain stands on the triangle.
std::array<double, 8> membrane_values(const std::array<glm::dvec3, 3>& x, const glm::dvec3& grain,
                                      const FabricMatrix& matrix);

/// Adds the elements of a body whose material has a fabric. The mesh is in world space; `grain` is turned as
/// the body is. An error names the first triangle that the grain stands on (within a degree) or that has no
/// texture coordinates where the grain follows them.
void add_membrane(Body& body, const Checker& out);

/// Of each triangle of a resolved body with a fabric, in the order of the mesh: a unit vector along the warp
/// at rest.
std::vector<glm::dvec3> warp_directions(const Body& body);

/// Of the strain that sweeps over constraints may leave of springs, what they may leave of a body's
/// membranes, of which each corner hangs from several triangles at once: a ninth, and 10 times shear over
/// yarn of that where yarns are stiffer; 1/144 at least. Without that the noise that yarns make in shear
/// never dies down (docs/methods.md). 1 of bodies without membranes.
double membrane_share(const Body& resolved);

} // namespace taut::scene_file
