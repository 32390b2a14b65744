// Colourings of random graphs, and colourings that are wrong on purpose.

#include "graphs.hpp"

#include <algorithm>
#include <random>

using namespace taut;
using namespace taut::graphs;

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
