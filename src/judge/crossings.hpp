#pragma once
// Which triangles of a surface go through each other, exactly.

#include "taut/judge/surface.hpp"

#include <glm/vec3.hpp>

namespace taut::judging {

/// An edge and a triangle without a common vertex that have a point in common.
struct CrossingEdge
{
    std::uint32_t edge = 0, triangle = 0; ///< of Surface::edges and Surface::triangles
};

/// All of them that are judged (Surface::judged), in order of the edges; exact, touching counts.
std::vector<CrossingEdge> crossing_edges(const Surface& surface, const std::vector<glm::dvec3>& positions);

/// Pairs of triangles, lower number first, in order and each once: an edge of one meets the other, and that
/// edge and that triangle have no vertex in common. Touching counts. Two triangles with one common vertex are
/// a pair if an edge without it meets the other; two with a common edge never are.
std::vector<std::array<std::uint32_t, 2>> intersecting_triangles(const Surface& surface,
                                                                 const std::vector<glm::dvec3>& positions);

} // namespace taut::judging
