#pragma once
// Closed surfaces of triangles and the volume within them, in fp64.

#include "taut/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// E = (V - rest_volume)^2 / (2 compliance), V the signed volume within the surface.
struct SurfaceElement
{
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< of the body's own mesh
    double rest_volume = 0;                              ///< m^3, negative where triangles look inwards
    double compliance = 0;                               ///< m^6/J, >= 0; 0 = rigid
};

/// Whether the volume within the surface of a resolved body is to be held: closed cloth with a
/// volume_stiffness, or springs in tetrahedra whose material.volume is "surface".
bool holds_surface_volume(const Body& body);
/// That of a body for which holds_surface_volume.
SurfaceElement surface_element(const Body& body);

/// An edge, and how often triangles run along it: upwards by vertex number, and downwards.
struct UnpairedEdge
{
    std::uint32_t low = 0, high = 0; ///< vertices
    std::uint32_t up = 0, down = 0;
};
/// Edges that are not run along equally often both ways, ascending: none where a surface is closed and all
/// its triangles look to the same side.
std::vector<UnpairedEdge> unpaired_edges(std::span<const std::array<std::uint32_t, 3>> triangles);

/// Throws Error{bad_input} where a surface is open or its triangles do not all look to the same side, and
/// Error{degenerate_rest} where it encloses nothing. `where` begins the message, `setting` is what may be 0.
void check_surface(const Body& body, const std::string& where,
                   const std::string& setting = "volume_stiffness");

/// m^3, signed: a sixth of the triple products of the triangles, about their first corner (far from the
/// origin the terms would cancel).
double enclosed_volume(std::span<const std::array<std::uint32_t, 3>> triangles,
                       std::span<const glm::dvec3> x);
/// m^2: how that changes with each vertex; `out` has the size of x and is added to, times `factor`.
void add_volume_gradient(std::span<const std::array<std::uint32_t, 3>> triangles,
                         std::span<const glm::dvec3> x, double factor, std::span<glm::dvec3> out);

} // namespace taut
