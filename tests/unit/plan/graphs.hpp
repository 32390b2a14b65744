#pragma once
// Graphs for the tests of colourings, and what they look at.

#include "support/catch.hpp"
#include "taut/plan/colouring.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace taut::graphs {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

inline ConstraintGraph graph_of(std::uint32_t vertices, const Edges& edges)
{
    ConstraintGraph graph{vertices, 2, {}, {}};
    for (const auto& [a, b] : edges)
    {
        graph.vertices.push_back(a); // insert() of both draws a false alarm from g++ 12
        graph.vertices.push_back(b);
    }
    return graph;
}

inline ConstraintGraph graph_of(std::uint32_t vertices, std::span<const GridSpring> springs)
{
    Edges edges;
    for (const GridSpring& s : springs)
    {
        edges.emplace_back(s.a, s.b);
    }
    return graph_of(vertices, edges);
}

inline ConstraintGraph star(std::uint32_t springs)
{
    Edges edges;
    for (std::uint32_t i = 1; i <= springs; ++i)
    {
        edges.emplace_back(0, i);
    }
    return graph_of(springs + 1, edges);
}

/// Edges of `count` triangles round vertex 0 (case C02), spokes first.
inline ConstraintGraph fan(std::uint32_t count)
{
    ConstraintGraph graph = star(count + 1);
    for (std::uint32_t i = 1; i <= count; ++i)
    {
        graph.vertices.insert(graph.vertices.end(), {i, i + 1});
    }
    return graph;
}

inline std::vector<std::uint32_t> sizes(const Colouring& c)
{
    std::vector<std::uint32_t> out;
    for (std::size_t k = 0; k < c.colour_count(); ++k)
    {
        out.push_back(c.colour_start[k + 1] - c.colour_start[k]);
    }
    return out;
}

inline std::uint32_t largest(const std::vector<std::uint32_t>& v)
{
    return *std::max_element(v.begin(), v.end());
}
inline std::uint32_t smallest(const std::vector<std::uint32_t>& v)
{
    return *std::min_element(v.begin(), v.end());
}

inline std::uint32_t degree_of(const ConstraintGraph& graph)
{
    std::vector<std::uint32_t> degree(graph.vertex_count, 0);
    for (const std::uint32_t v : graph.vertices)
    {
        degree[v] += graph.fixed.empty() || !graph.fixed[v] ? 1 : 0;
    }
    return graph.vertices.empty() ? 0 : largest(degree);
}

inline bool equal(const Colouring& a, const Colouring& b)
{
    return a.order == b.order && a.colour_start == b.colour_start && a.hubs == b.hubs &&
           a.hub_constraints == b.hub_constraints && a.hub_start == b.hub_start;
}

inline void require_valid(const Colouring& c, const ConstraintGraph& graph)
{
    std::string why;
    const bool ok = valid(c, graph, &why);
    INFO(why);
    REQUIRE(ok);
}

inline std::uint32_t below(std::mt19937& random, std::uint32_t limit)
{
    return static_cast<std::uint32_t>(random() % limit);
}

/// Distinct vertices in each constraint, some vertices fixed.
inline ConstraintGraph random_graph(std::mt19937& random, std::uint32_t stride)
{
    ConstraintGraph graph;
    graph.vertex_count = stride + below(random, 60);
    graph.stride = stride;
    const std::uint32_t count = below(random, 400);
    for (std::uint32_t c = 0; c < count; ++c)
    {
        std::set<std::uint32_t> corners;
        while (corners.size() < stride)
        {
            corners.insert(below(random, graph.vertex_count));
        }
        std::vector<std::uint32_t> list(corners.begin(), corners.end());
        std::shuffle(list.begin(), list.end(), random);
        graph.vertices.insert(graph.vertices.end(), list.begin(), list.end());
    }
    if (below(random, 2) == 0)
    {
        for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
        {
            graph.fixed.push_back(below(random, 8) == 0);
        }
    }
    return graph;
}

} // namespace taut::graphs
