#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/solid.hpp"
#include "taut/plan/vertex_colouring.hpp"

#include <algorithm>

using namespace taut;

namespace {

/// The graph of a body's springs and hinges.
VertexGraph graph_of(const Body& body, bool with_hinges, std::vector<bool> free = {})
{
    free.resize(body.mesh.positions.size(), true);
    VertexGraph graph(free);
    for (const StretchElement& e : stretch_elements(body))
        graph.add(std::vector<std::uint32_t>{e.a, e.b}, 2);
    if (with_hinges)
        for (const BendElement& e : bend_elements(body))
            graph.add(std::vector<std::uint32_t>{e.edge0, e.edge1, e.wing0, e.wing1}, 4);
    graph.finish();
    return graph;
}

/// No two neighbours of one colour; every free vertex has one, no other has.
bool valid(const VertexGraph& graph, const VertexColours& colours)
{
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
    {
        if (graph.free[v] != (colours.colour[v] < colours.count))
            return false;
        for (const std::uint32_t other : graph.neighbours[v])
            if (colours.colour[v] == colours.colour[other])
                return false;
    }
    return true;
}

std::vector<std::size_t> sizes(const VertexColours& colours)
{
    std::vector<std::size_t> out(colours.count, 0);
    for (const std::uint32_t c : colours.colour)
        if (c != kNoColour)
            ++out[c];
    return out;
}

Body network(std::uint32_t n, double structural, double shear, double bend)
{
    Scene scene;
    Body body;
    body.shape.cells = {n, n};
    body.shape.network = {true, structural, shear, bend};
    scene.bodies = {body};
    return resolve(scene).bodies[0];
}

} // namespace

TEST_CASE("vertices of a grid network take 2, 4 and 5 colours (methods 4.1)")
{
    struct Case
    {
        double structural, shear, bend;
        std::uint32_t colours;
    };
    for (const Case& c : {Case{1, 0, 0, 2}, Case{1, 1, 0, 4}, Case{1, 1, 1, 5}})
    {
        const Body body = network(20, c.structural, c.shear, c.bend);
        const VertexGraph graph = graph_of(body, false);
        const VertexColours found = colour_vertices(graph, body.mesh.grid_columns);
        CAPTURE(c.colours);
        CHECK(found.count == c.colours);
        CHECK(found.lattice);
        CHECK(valid(graph, found));
        const auto size = sizes(found);
        CHECK(*std::max_element(size.begin(), size.end()) - *std::min_element(size.begin(), size.end()) <=
              21);
    }
}

TEST_CASE("a triangle grid with hinges is coloured, by a lattice or greedily, and no colour is much larger")
{
    for (const char* diagonals : {"alternating", "uniform"})
    {
        Scene scene;
        Body body;
        body.shape.cells = {17, 12};
        body.shape.diagonals = option_named<Diagonals>(diagonals);
        body.material.bending_stiffness = 1;
        scene.bodies = {body};
        body = resolve(scene).bodies[0];
        const VertexGraph graph = graph_of(body, true);
        for (const std::uint32_t columns : {0u, body.mesh.grid_columns})
        {
            const VertexColours found = colour_vertices(graph, columns);
            CAPTURE(diagonals, columns, found.count, found.lattice);
            CHECK(valid(graph, found));
            CHECK(found.count <= 12);
            const auto size = sizes(found);
            CHECK(*std::max_element(size.begin(), size.end()) <= 3 * (18 * 13 / found.count));
        }
    }
}

TEST_CASE("held vertices have no colour and stand in nobody's way")
{
    const Body body = network(6, 1, 0, 0);
    std::vector<bool> free(49, true);
    for (std::uint32_t v = 0; v < 49; v += 2)
        free[v] = false; // every other: no two free ones meet
    const VertexGraph graph = graph_of(body, false, free);
    const VertexColours found = colour_vertices(graph, body.mesh.grid_columns);
    CHECK(found.count == 1);
    CHECK(valid(graph, found));
    CHECK(colour_vertices(graph_of(body, false, std::vector<bool>(49, false))).count == 0);
}

TEST_CASE("random graphs take at most degree + 1 colours, the same ones every time")
{
    conformance::Random random(21);
    for (int draw = 0; draw < 50; ++draw)
    {
        const std::uint32_t n = 2 + random.below(80);
        std::vector<bool> free;
        for (std::uint32_t v = 0; v < n; ++v)
            free.push_back(!random.chance(0.1));
        VertexGraph graph(free);
        for (std::uint32_t k = 0; k < 2 * n; ++k)
            graph.add(std::vector<std::uint32_t>{random.below(n), random.below(n), random.below(n),
                                                 random.below(n)},
                      draw % 2 == 0 ? 2 : 4);
        graph.finish();
        std::size_t degree = 0;
        for (const auto& list : graph.neighbours)
            degree = std::max(degree, list.size());
        const VertexColours found = colour_vertices(graph);
        CAPTURE(draw);
        CHECK(valid(graph, found));
        CHECK(found.count <= degree + 1);
        CHECK(colour_vertices(graph).colour == found.colour);
    }
}

TEST_CASE("boxes of tetrahedra take four vertex colours of equal size; further springs fall back to greedy")
{
    for (const bool five : {false, true})
    {
        const Mesh mesh = make_box({6, 7, 8}, glm::dvec3(1), five);
        std::vector<glm::uvec3> places;
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
            places.emplace_back(v % 7, v / 7 % 8, v / 56);
        std::vector<bool> free(mesh.positions.size(), true);
        free[5] = false;
        VertexGraph graph(free);
        for (const auto& t : mesh.tetrahedra)
            graph.add(t, 4);
        VertexGraph more = graph;
        graph.finish();
        const VertexColours found = colour_box(graph, places);
        CAPTURE(five);
        CHECK(found.count == 4);
        CHECK(found.lattice);
        CHECK(valid(graph, found));
        const auto size = sizes(found);
        CHECK(*std::max_element(size.begin(), size.end()) - *std::min_element(size.begin(), size.end()) <= 8);
        for (std::uint32_t v = 0; v + 4 < 56; ++v) // four cells on: both colourings give the same colour
            more.add(std::vector<std::uint32_t>{v, v + 4 * 56}, 2);
        more.finish();
        const VertexColours other = colour_box(more, places);
        CHECK(!other.lattice);
        CHECK(valid(more, other));
    }
}
