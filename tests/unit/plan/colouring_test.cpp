// Colourings: what they promise, on graphs with known answers and on random ones.

#include "support/catch.hpp"
#include "taut/plan/colouring.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <set>

using namespace taut;

namespace {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

ConstraintGraph graph_of(std::uint32_t vertices, const Edges& edges)
{
    ConstraintGraph graph{vertices, 2, {}, {}};
    for (const auto& [a, b] : edges)
    {
        graph.vertices.insert(graph.vertices.end(), {a, b});
    }
    return graph;
}

ConstraintGraph graph_of(std::uint32_t vertices, std::span<const GridSpring> springs)
{
    Edges edges;
    for (const GridSpring& s : springs)
    {
        edges.emplace_back(s.a, s.b);
    }
    return graph_of(vertices, edges);
}

ConstraintGraph star(std::uint32_t springs)
{
    Edges edges;
    for (std::uint32_t i = 1; i <= springs; ++i)
    {
        edges.emplace_back(0, i);
    }
    return graph_of(springs + 1, edges);
}

/// Edges of `count` triangles round vertex 0 (case C02), spokes first.
ConstraintGraph fan(std::uint32_t count)
{
    ConstraintGraph graph = star(count + 1);
    for (std::uint32_t i = 1; i <= count; ++i)
    {
        graph.vertices.insert(graph.vertices.end(), {i, i + 1});
    }
    return graph;
}

std::vector<std::uint32_t> sizes(const Colouring& c)
{
    std::vector<std::uint32_t> out;
    for (std::size_t k = 0; k < c.colour_count(); ++k)
    {
        out.push_back(c.colour_start[k + 1] - c.colour_start[k]);
    }
    return out;
}

std::uint32_t largest(const std::vector<std::uint32_t>& v) { return *std::max_element(v.begin(), v.end()); }
std::uint32_t smallest(const std::vector<std::uint32_t>& v) { return *std::min_element(v.begin(), v.end()); }

std::uint32_t degree_of(const ConstraintGraph& graph)
{
    std::vector<std::uint32_t> degree(graph.vertex_count, 0);
    for (const std::uint32_t v : graph.vertices)
    {
        degree[v] += graph.fixed.empty() || !graph.fixed[v] ? 1 : 0;
    }
    return graph.vertices.empty() ? 0 : largest(degree);
}

bool equal(const Colouring& a, const Colouring& b)
{
    return a.order == b.order && a.colour_start == b.colour_start && a.hubs == b.hubs &&
           a.hub_constraints == b.hub_constraints && a.hub_start == b.hub_start;
}

void require_valid(const Colouring& c, const ConstraintGraph& graph)
{
    std::string why;
    const bool ok = valid(c, graph, &why);
    INFO(why);
    REQUIRE(ok);
}

std::uint32_t below(std::mt19937& random, std::uint32_t limit)
{
    return static_cast<std::uint32_t>(random() % limit);
}

/// Distinct vertices in each constraint, some vertices fixed.
ConstraintGraph random_graph(std::mt19937& random, std::uint32_t stride)
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

} // namespace

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

TEST_CASE("springs of a grid number what the formula says, in 4, 8 and 12 valid even colours", "[colouring]")
{
    for (const std::uint32_t n : {32u, 64u, 128u, 256u})
    {
        const std::uint32_t structural = 2 * n * (n - 1);
        const std::uint32_t with_shear = structural + 2 * (n - 1) * (n - 1);
        const std::vector<std::uint32_t> counts = {structural, with_shear, with_shear + 2 * n * (n - 2)};
        for (std::uint32_t level = 0; level < 3; ++level)
        {
            const auto springs = grid_springs(n, n, level > 0, level > 1);
            const Colouring c = colouring_of(springs);
            CHECK(springs.size() == counts[level]);
            CHECK(c.colour_count() == 4 * (level + 1));
            CHECK(largest(sizes(c)) - smallest(sizes(c)) <= 2 * n); // an odd number of rows is left
            CHECK(std::is_sorted(c.order.begin(), c.order.end()));
            require_valid(c, graph_of(n * n, springs));
        }
    }
    CHECK(grid_springs(256, 256, true, true).size() == 390658);
}

TEST_CASE("springs of a grid join the neighbours they should, each pair once", "[colouring]")
{
    const std::uint32_t columns = 7, rows = 5;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen, expected;
    for (const GridSpring& s : grid_springs(columns, rows, true, true))
    {
        seen.insert(std::minmax(s.a, s.b));
    }
    for (int a = 0; a < 35; ++a)
    {
        for (int b = a + 1; b < 35; ++b)
        {
            const int dx = std::abs(a % 7 - b % 7), dy = b / 7 - a / 7;
            if (dx + dy == 1 || (dx == 1 && dy == 1) || (dx == 2 && dy == 0) || (dx == 0 && dy == 2))
            {
                expected.emplace(a, b);
            }
        }
    }
    CHECK(seen == expected);
    CHECK(grid_springs(columns, rows, true, true).size() == expected.size());
}

TEST_CASE("narrow grids and grids without diagonals keep valid colours, none empty", "[colouring]")
{
    for (std::uint32_t columns = 0; columns < 6; ++columns)
    {
        for (std::uint32_t rows = 0; rows < 6; ++rows)
        {
            for (const bool diagonals : {false, true})
            {
                for (const bool skip : {false, true})
                {
                    const auto springs = grid_springs(columns, rows, diagonals, skip);
                    const Colouring c = colouring_of(springs);
                    require_valid(c, graph_of(columns * rows, springs));
                    CHECK((c.colour_count() == 0 || smallest(sizes(c)) > 0));
                }
            }
        }
    }
    CHECK(colouring_of(grid_springs(9, 9, false, true)).colour_count() == 8);
    CHECK(colouring_of(grid_springs(1, 9, true, false)).colour_count() == 2);
}

TEST_CASE("greedy colours of a 64 x 64 grid are at most the published 4, 8 and 13", "[colouring]")
{
    const std::vector<std::size_t> published = {4, 8, 13};
    for (std::uint32_t level = 0; level < 3; ++level)
    {
        const auto springs = grid_springs(64, 64, level > 0, level > 1);
        const ConstraintGraph graph = graph_of(64 * 64, springs);
        for (const bool balance : {false, true})
        {
            const Colouring c = colour_greedy(graph, {64, balance});
            require_valid(c, graph);
            CHECK(c.colour_count() <= published[level]);
            CHECK(c.colour_count() >= 4 * (level + 1));
        }
    }
}

TEST_CASE("springs in random order cost one colour more than the degree at most", "[colouring]")
{
    auto springs = grid_springs(64, 64, true, true);
    std::shuffle(springs.begin(), springs.end(), std::mt19937(1));
    const ConstraintGraph graph = graph_of(64 * 64, springs);
    const Colouring plain = colour_greedy(graph, {64, false}), even = colour_greedy(graph);
    require_valid(plain, graph);
    require_valid(even, graph);
    CHECK(plain.colour_count() <= 13); // plain first fit takes 16
    CHECK(even.colour_count() <= plain.colour_count());
    CHECK(smallest(sizes(even)) > smallest(sizes(plain)));
    const std::size_t mean = springs.size() / even.colour_count();
    CHECK(smallest(sizes(plain)) * 100 < mean * 90);
    CHECK(smallest(sizes(even)) * 100 > mean * 95);
    CHECK(largest(sizes(even)) * 100 < mean * 105);
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

TEST_CASE("random graphs get valid colours, the same every time", "[colouring]")
{
    std::mt19937 random(2024);
    for (int trial = 0; trial < 300; ++trial)
    {
        const std::uint32_t stride = 1 + below(random, 4);
        const ConstraintGraph graph = random_graph(random, stride);
        for (const std::uint32_t hub_degree : {0u, 3u, 10u, 64u})
        {
            for (const bool balance : {false, true})
            {
                const Colouring c = colour_greedy(graph, {hub_degree, balance});
                require_valid(c, graph);
                CHECK(equal(c, colour_greedy(graph, {hub_degree, balance})));
                CHECK((c.colour_count() == 0 || smallest(sizes(c)) > 0));
                CHECK((hub_degree > 0 || c.hubs.empty()));
            }
        }
    }
}

TEST_CASE("random simple graphs need at most degree + 1 colours without hubs", "[colouring]")
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 300; ++trial)
    {
        const std::uint32_t vertices = 2 + below(random, 50);
        const std::uint32_t density = 1 + below(random, 8);
        Edges edges;
        for (std::uint32_t a = 0; a < vertices; ++a)
        {
            for (std::uint32_t b = a + 1; b < vertices; ++b)
            {
                if (below(random, 8) < density)
                {
                    edges.emplace_back(a, b);
                }
            }
        }
        std::shuffle(edges.begin(), edges.end(), random);
        ConstraintGraph graph = graph_of(vertices, edges);
        for (std::uint32_t v = 0; v < vertices && trial % 3 == 0; ++v)
        {
            graph.fixed.push_back(below(random, 5) == 0);
        }
        for (const bool balance : {false, true})
        {
            const Colouring c = colour_greedy(graph, {0, balance});
            require_valid(c, graph);
            CHECK(c.colour_count() <= degree_of(graph) + 1);
        }
    }
}

TEST_CASE("a planted conflict is reported with both constraints, the colour and the vertex", "[colouring]")
{
    const auto springs = grid_springs(16, 16, true, true);
    const ConstraintGraph graph = graph_of(256, springs);
    const Colouring good = colouring_of(springs);
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial)
    {
        // One constraint moves into the colour of one that shares a vertex with it.
        auto planted = springs;
        const std::size_t i = random() % planted.size();
        std::size_t j = 0;
        while (j == i || (planted[j].a != planted[i].b && planted[j].b != planted[i].a))
        {
            j = random() % planted.size();
        }
        planted[i].colour = planted[j].colour;
        std::string why;
        CHECK_FALSE(valid(colouring_of(planted), graph, &why));
        CHECK(why.find("both write vertex") != std::string::npos);
    }
    std::string why = "old";
    CHECK(valid(good, graph, &why));
    CHECK(why.empty());
    ConstraintGraph pair = graph_of(3, Edges{{0, 1}, {1, 2}});
    const std::vector<GridSpring> bad = {{0, 1, 0}, {1, 2, 0}};
    CHECK_FALSE(valid(colouring_of(bad), pair, &why));
    CHECK(why == "constraints 0 and 1 of colour 0 both write vertex 1");
}

TEST_CASE("a colouring that loses, repeats or invents a constraint is not valid", "[colouring]")
{
    const ConstraintGraph graph = fan(20);
    const Colouring good = colour_greedy(graph, {10, true});
    REQUIRE(valid(good, graph));
    REQUIRE(good.hubs.size() == 1);
    const auto broken = [&](auto change) {
        Colouring bad = good;
        change(bad);
        std::string why;
        return !valid(bad, graph, &why) && !why.empty();
    };
    CHECK(broken([](Colouring& c) { c.order[0] = c.order[1]; }));
    CHECK(broken([](Colouring& c) { c.order[0] = 1000; }));
    CHECK(broken([](Colouring& c) { c.order.pop_back(); }));
    CHECK(broken([](Colouring& c) {
        c.order.pop_back();
        --c.colour_start.back();
    }));
    CHECK(broken([](Colouring& c) { c.colour_start[0] = 1; }));
    CHECK(broken([](Colouring& c) { c.hub_start.back() += 1; }));
    CHECK(broken([](Colouring& c) { c.hubs[0] = 5; }));
    CHECK(broken([](Colouring& c) { std::swap(c.order[0], c.hub_constraints[0]); }));
    CHECK(broken([](Colouring& c) { std::swap(c.order.front(), c.order.back()); }));
}
