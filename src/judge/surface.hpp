#pragma once
// What a judge knows of triangles before it sees where they are: edges, parts, borders.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace taut::judging {

using Triangle = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>; ///< lower vertex first

struct Surface
{
    std::size_t vertices = 0;
    std::vector<Triangle> triangles;
    std::vector<Edge> edges;                                ///< of the triangles, each once, in order
    std::vector<std::vector<std::uint32_t>> edge_triangles; ///< per edge
    std::vector<std::uint32_t>
        part; ///< per vertex: number of the connected part, from 0 in order of vertices
    std::size_t parts = 0;
    std::vector<std::uint32_t>
        closed; ///< parts with two triangles at every edge, wound alike: they have a volume
    /// Borders that are simple closed curves: vertices along the winding. Others are left out.
    std::vector<std::vector<std::uint32_t>> borders;
};

/// Indices are below `vertices`. Vertices of no triangle are parts of their own without triangles.
Surface make_surface(std::size_t vertices, std::vector<Triangle> triangles);

inline bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

} // namespace taut::judging
