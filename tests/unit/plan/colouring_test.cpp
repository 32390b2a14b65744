// Colourings: what they promise, on graphs with known answers.

#include "graphs.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

using namespace taut;
using namespace taut::graphs;

TEST_CASE("an empty graph and one vertex have no colours", "[colouring]")
{
    for (const std::uint32_t vertices : {0u, 1u})
    {
        const ConstraintGraph graph = graph_of(vertices, Edges{});
        const Colouring c = colour_greedy(graph);
        CHECK(c.colour_count() == 0);
        CHECK(c.order.empty());
        CHECK(c.hubs.empty());
        CHECK(c.hub_start.size() == 1);
        require_valid(c, graph);
    }
    CHECK(valid(Colouring{}, ConstraintGraph{}));
    CHECK(colouring_of({}).colour_count() == 0);
}

TEST_CASE("C09: a chain of 100,000 links has two equal colours", "[colouring]")
{
    Edges edges;
    for (std::uint32_t i = 0; i < 100000; ++i)
    {
        edges.emplace_back(i, i + 1);
    }
    const ConstraintGraph graph = graph_of(100001, edges);
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(sizes(c) == std::vector<std::uint32_t>{50000, 50000});
}

TEST_CASE("C03: a star of 10,000 springs is one hub without colours", "[colouring]")
{
    const ConstraintGraph graph = star(10000);
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.colour_count() == 0);
    CHECK(c.hubs == std::vector<std::uint32_t>{0});
    CHECK(c.hub_constraints.size() == 10000);
    CHECK(std::is_sorted(c.hub_constraints.begin(), c.hub_constraints.end()));

    const Colouring without = colour_greedy(graph, {0, false});
    require_valid(without, graph);
    CHECK(without.colour_count() == 10000);
}

TEST_CASE("a vertex of exactly hub_degree constraints is no hub, one more makes it one", "[colouring]")
{
    CHECK(colour_greedy(star(64)).colour_count() == 64);
    CHECK(colour_greedy(star(64)).hubs.empty());
    CHECK(colour_greedy(star(65)).hubs.size() == 1);
    CHECK(colour_greedy(star(5), {4, true}).hubs.size() == 1);
}

TEST_CASE("C02: a fan of 1000 triangles leaves its centre out and colours its rim with two", "[colouring]")
{
    const ConstraintGraph graph = fan(1000);
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.hubs == std::vector<std::uint32_t>{0});
    CHECK(sizes(c) == std::vector<std::uint32_t>{500, 500});
    const Colouring without = colour_greedy(graph, {0, false});
    require_valid(without, graph);
    CHECK(without.colour_count() <= 1002);
}

TEST_CASE("a constraint between two hubs belongs to the lower one", "[colouring]")
{
    Edges edges = {{9, 3}};
    for (std::uint32_t i = 0; i < 4; ++i)
    {
        edges.emplace_back(9, 10 + i);
        edges.emplace_back(3, 14 + i);
    }
    const ConstraintGraph graph = graph_of(18, edges);
    const Colouring c = colour_greedy(graph, {4, true});
    require_valid(c, graph);
    CHECK(c.hubs == std::vector<std::uint32_t>{3, 9});
    CHECK(c.hub_start == std::vector<std::uint32_t>{0, 5, 9});
    CHECK(c.hub_constraints == std::vector<std::uint32_t>{0, 2, 4, 6, 8, 1, 3, 5, 7});
}

TEST_CASE("a hub whose constraints all belong to lower hubs is not listed", "[colouring]")
{
    Edges edges;
    for (std::uint32_t a = 0; a < 8; ++a)
    {
        for (std::uint32_t b = a + 1; b < 8; ++b)
        {
            edges.emplace_back(a, b);
        }
    }
    const ConstraintGraph graph = graph_of(8, edges);
    const Colouring c = colour_greedy(graph, {6, true});
    require_valid(c, graph);
    CHECK(c.hubs == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6});
    CHECK(c.hub_constraints.size() == 28);
}

TEST_CASE("a fixed vertex is in nobody's way and never a hub", "[colouring]")
{
    ConstraintGraph graph = star(1000);
    graph.fixed.assign(1001, false);
    graph.fixed[0] = true;
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.hubs.empty());
    CHECK(c.colour_count() == 1);

    graph.fixed.assign(1001, true);
    CHECK(colour_greedy(graph).colour_count() == 1);
    graph.fixed.clear();
    CHECK_FALSE(valid(c, graph));
}

TEST_CASE("C06: a constraint that occurs twice gets two colours", "[colouring]")
{
    const ConstraintGraph graph = graph_of(3, Edges{{0, 1}, {1, 0}, {1, 2}});
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.colour_count() == 3);
}

TEST_CASE("a triangle of pairs that occur many times is still coloured", "[colouring]")
{
    Edges edges; // Shannon's graph: every two of the 3 m edges share a vertex
    for (std::uint32_t i = 0; i < 5; ++i)
    {
        edges.insert(edges.end(), {{0, 1}, {1, 2}, {2, 0}});
    }
    const ConstraintGraph graph = graph_of(3, edges);
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.colour_count() == 15);
}

TEST_CASE("a constraint that names a vertex twice does not stand in its own way", "[colouring]")
{
    const ConstraintGraph graph = graph_of(2, Edges{{0, 0}, {0, 1}, {1, 1}});
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(c.colour_count() == 2);
}

TEST_CASE("within a colour constraints go by lowest vertex, then by number", "[colouring]")
{
    const ConstraintGraph graph = graph_of(8, Edges{{7, 6}, {1, 5}, {4, 3}, {2, 0}});
    CHECK(colour_greedy(graph).order == std::vector<std::uint32_t>{3, 1, 2, 0});
    ConstraintGraph held = graph_of(4, Edges{{0, 3}, {2, 0}, {0, 1}});
    held.fixed = {true, false, false, false};
    CHECK(colour_greedy(held).order == std::vector<std::uint32_t>{0, 1, 2});
}

TEST_CASE("first fit alone gives the lowest colour that is free", "[colouring]")
{
    // 0-1 blue, 2-3 blue, 1-2 red, 3-4 red, 4-5 blue: worked by hand.
    const ConstraintGraph graph = graph_of(6, Edges{{0, 1}, {2, 3}, {1, 2}, {3, 4}, {4, 5}});
    const Colouring c = colour_greedy(graph, {64, false});
    CHECK(c.order == std::vector<std::uint32_t>{0, 1, 4, 2, 3});
    CHECK(c.colour_start == std::vector<std::uint32_t>{0, 3, 5});
}

TEST_CASE("a colour of one link in a chain is dissolved along the chain", "[colouring]")
{
    // Coloured from both ends towards link 10, which finds colour 1 on one side and 0 on the other.
    Edges edges;
    for (std::uint32_t i = 0; i < 10; ++i)
    {
        edges.emplace_back(i, i + 1);
    }
    for (std::uint32_t i = 21; i >= 10; --i)
    {
        edges.emplace_back(i, i + 1);
    }
    const ConstraintGraph graph = graph_of(23, edges);
    CHECK(sizes(colour_greedy(graph, {64, false})) == std::vector<std::uint32_t>{11, 10, 1});
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(sizes(c) == std::vector<std::uint32_t>{11, 11});
}

TEST_CASE("a colour of one constraint of three vertices is dissolved by moving a neighbour", "[colouring]")
{
    // Chains of four, each constraint with a third vertex of its own; the first chain in a bad order.
    ConstraintGraph graph{6 * 5 + 6 * 4, 3, {}, {}};
    std::uint32_t own = 6 * 5;
    for (std::uint32_t chain = 0; chain < 6; ++chain)
    {
        const std::array<std::uint32_t, 4> bad = {0, 3, 2, 1}, good = {0, 1, 2, 3};
        for (const std::uint32_t link : chain == 0 ? bad : good)
        {
            const std::uint32_t a = 5 * chain + link;
            graph.vertices.insert(graph.vertices.end(), {a, a + 1, own++});
        }
    }
    CHECK(sizes(colour_greedy(graph, {64, false})) == std::vector<std::uint32_t>{12, 11, 1});
    const Colouring c = colour_greedy(graph);
    require_valid(c, graph);
    CHECK(sizes(c) == std::vector<std::uint32_t>{12, 12});
}
