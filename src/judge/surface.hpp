#pragma once
// What a judge knows of triangles before it sees where they are: edges, parts, borders.

#include <algorithm>
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
    /// Per vertex: whether it goes where somebody takes it, so that what it does among its like is not
    /// judged. Empty: none does.
    std::vector<bool> led;

    /// Whether a vertex of two features goes by itself.
    bool judged(const auto& feature, const auto& other) const
    {
        const auto is_led = [&](std::uint32_t v) { return led[v]; };
        return led.empty() || !std::all_of(feature.begin(), feature.end(), is_led) ||
               !std::all_of(other.begin(), other.end(), is_led);
    }
};

/// Indices are below `vertices`. Vertices of no triangle are parts of their own without triangles.
Surface make_surface(std::size_t vertices, std::vector<Triangle> triangles, std::vector<bool> led = {});

inline bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

} // namespace taut::judging
