#include "taut/judge/crossings.hpp"

#include "taut/judge/exact.hpp"
#include "taut/judge/triangle_tree.hpp"

#include <algorithm>

namespace taut::judging {

std::vector<CrossingEdge> crossing_edges(const Surface& surface, const std::vector<glm::dvec3>& positions)
{
    const TriangleTrees trees(surface, positions);
    std::vector<CrossingEdge> out;
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    {
        const std::uint32_t a = surface.edges[e][0], b = surface.edges[e][1];
        Box box;
        box.add(positions[a]);
        box.add(positions[b]);
        trees.overlapping(surface.is_led(surface.edges[e]), box, [&](std::uint32_t t) {
            const Triangle& other = surface.triangles[t];
            if (!has(other, a) && !has(other, b) && surface.judged(surface.edges[e], other) &&
                segment_meets_triangle(positions[a], positions[b],
                                       {positions[other[0]], positions[other[1]], positions[other[2]]}))
                out.push_back({e, t});
        });
    }
    return out;
}

std::vector<std::array<std::uint32_t, 2>> intersecting_triangles(const Surface& surface,
                                                                 const std::vector<glm::dvec3>& positions)
{
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const auto& [edge, triangle] : crossing_edges(surface, positions))
        for (const std::uint32_t own : surface.edge_triangles[edge])
            pairs.push_back({std::min(own, triangle), std::max(own, triangle)});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace taut::judging
