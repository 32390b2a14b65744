#pragma once
// Pure functions over meshes and constraint graphs: edges, hinges, vertex order, colours.

#include "taut/plan/colouring.hpp"
#include "taut/scene/mesh.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace taut {

/// An interior or boundary edge with the triangles at it.
struct MeshEdge
{
    std::uint32_t a = 0, b = 0;           ///< a < b
    std::vector<std::uint32_t> triangles; ///< ascending; empty for a link and inside a solid
};

/// Every edge once, sorted by (a, b): the sides of the triangles, the links, the edges of the
/// tetrahedra. Throws
/// Error{bad_input} for a corner that is no vertex and for an edge from a vertex to itself.
std::vector<MeshEdge> mesh_edges(const Mesh& mesh);

/// The same one by one: a million edges are no million lists. `triangles` is of this call alone.
using EdgeVisit =
    std::function<void(std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> triangles)>;
void each_edge(const Mesh& mesh, const EdgeVisit& visit);

/// Two triangles that share an edge: wing0 is opposite in the first, wing1 in the second. Along
/// edge0->edge1 the first triangle is wound (edge0, edge1, wing0), however the second is wound.
struct Hinge
{
    std::uint32_t edge0 = 0, edge1 = 0, wing0 = 0, wing1 = 0;
};

/// One hinge for each pair of adjacent triangles, in ascending order of edge, then of triangles: an
/// edge with three triangles gives three (case C01). Two triangles on the same three corners have no
/// angle and give none. Deterministic. Throws as mesh_edges, and Error{limit} for an edge with more
/// than 1000 triangles, because pairs grow with the square.
std::vector<Hinge> mesh_hinges(const Mesh& mesh);

/// Old index of each new vertex: along a space-filling curve (Morton order of the rest positions, 21
/// bits an axis over the longest side of their box; equal codes keep their order).
std::vector<std::uint32_t> locality_order(std::span<const glm::dvec3> positions);

} // namespace taut
