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

/// Bodies of which some pass through others on purpose.
struct PassingBodies
{
    std::vector<std::uint32_t> body; ///< per vertex; empty: none passes through another one
    std::vector<std::uint32_t> kind; ///< per body
    std::vector<std::vector<bool>> passes; ///< per two kinds, both ways: what two different bodies of them do
};

struct Surface
{
    static constexpr std::uint32_t kNoPart = 0xffffffffu;

    std::size_t vertices = 0;
    std::vector<Triangle> triangles;
    std::vector<Edge> edges;                                ///< of the triangles, each once, in order
    std::vector<std::vector<std::uint32_t>> edge_triangles; ///< per edge
    std::vector<std::uint32_t>
        part; ///< per vertex: number of the connected part, from 0 in order of vertices, or kNoPart
    std::size_t parts = 0;
    std::vector<std::uint32_t>
        closed; ///< parts with two triangles at every edge, wound alike: they have a volume
    /// Borders that are simple closed curves: vertices along the winding. Others are left out.
    std::vector<std::vector<std::uint32_t>> borders;
    /// Per vertex: whether it goes where somebody takes it, so that what it does among its like is not
    /// judged. Empty: none does.
    std::vector<bool> led;
    PassingBodies passing;

    /// Whether a vertex of two features goes by itself, and they are to stay apart.
    bool judged(const auto& feature, const auto& other) const
    {
        if (!passing.body.empty())
        {
            const std::uint32_t a = passing.body[feature[0]], b = passing.body[other[0]];
            if (a != b && passing.passes[passing.kind[a]][passing.kind[b]])
                return false;
        }
        return !is_led(feature) || !is_led(other);
    }

    /// Whether all vertices of a feature are led.
    bool is_led(const auto& feature) const
    {
        return !led.empty() &&
               std::all_of(feature.begin(), feature.end(), [&](std::uint32_t v) { return led[v]; });
    }
};

/// Indices are below `vertices`. Vertices of no triangle, as inside a solid, are of no part.
Surface make_surface(std::size_t vertices, std::vector<Triangle> triangles, std::vector<bool> led = {},
                     PassingBodies passing = {});

inline bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

} // namespace taut::judging
