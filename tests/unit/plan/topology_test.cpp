// Edges and hinges, on meshes small enough to check by eye.

#include "meshes.hpp"
#include "support/catch.hpp"
#include "taut/plan/topology.hpp"
#include "taut/runtime/base/error.hpp"

#include <string>

using namespace taut;
using namespace taut::meshes;

namespace {

bool same(const Hinge& h, std::uint32_t edge0, std::uint32_t edge1, std::uint32_t wing0, std::uint32_t wing1)
{
    return h.edge0 == edge0 && h.edge1 == edge1 && h.wing0 == wing0 && h.wing1 == wing1;
}

/// The code of the error that an action throws; fails the test if it throws none.
template <class Action>
ErrorCode code_of(Action action, std::string* text = nullptr)
{
    try
    {
        action();
    }
    catch (const Error& error)
    {
        if (text != nullptr)
        {
            *text = error.what();
        }
        return error.code();
    }
    FAIL("nothing was thrown");
    return ErrorCode::io;
}

} // namespace

TEST_CASE("two triangles have five edges, sorted, and the shared one knows both", "[topology]")
{
    const auto edges = mesh_edges(mesh_of(4, {{0, 1, 2}, {2, 1, 3}}));
    REQUIRE(edges.size() == 5);
    const std::vector<std::array<std::uint32_t, 2>> expected = {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}};
    for (std::size_t i = 0; i < 5; ++i)
    {
        CHECK(edges[i].a == expected[i][0]);
        CHECK(edges[i].b == expected[i][1]);
        CHECK(edges[i].triangles.size() == (i == 2 ? 2u : 1u));
    }
    CHECK(edges[2].triangles == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a closed surface has two triangles at every edge", "[topology]")
{
    const Mesh mesh = tetrahedron_surface();
    const auto edges = mesh_edges(mesh);
    CHECK(edges.size() == 6);
    CHECK(std::all_of(edges.begin(), edges.end(), [](const MeshEdge& e) { return e.triangles.size() == 2; }));
    CHECK(mesh_hinges(mesh).size() == 6);
}

TEST_CASE("links are edges without triangles and join with a triangle's side", "[topology]")
{
    Mesh mesh = mesh_of(5, {{0, 1, 2}});
    mesh.links = {{4, 3}, {2, 0}, {3, 4}};
    const auto edges = mesh_edges(mesh);
    REQUIRE(edges.size() == 4);
    CHECK(edges[1].b == 2);
    CHECK(edges[1].triangles == std::vector<std::uint32_t>{0});
    CHECK(edges[3].a == 3);
    CHECK(edges[3].b == 4);
    CHECK(edges[3].triangles.empty());
    CHECK(mesh_hinges(mesh).empty());
}

TEST_CASE("a mesh of nothing, of one vertex or of a chain has no hinges", "[topology]")
{
    CHECK(mesh_edges(Mesh{}).empty());
    CHECK(mesh_edges(mesh_of(1, {})).empty());
    Mesh chain = mesh_of(100001, {});
    for (std::uint32_t i = 0; i < 100000; ++i)
    {
        chain.links.push_back({i, i + 1});
    }
    CHECK(mesh_edges(chain).size() == 100000);
    CHECK(mesh_hinges(chain).empty());
}

TEST_CASE("a hinge follows the winding of its first triangle", "[topology]")
{
    const auto hinges = mesh_hinges(mesh_of(4, {{0, 1, 2}, {2, 1, 3}}));
    REQUIRE(hinges.size() == 1);
    CHECK(same(hinges[0], 1, 2, 0, 3));
    const auto turned = mesh_hinges(mesh_of(4, {{0, 2, 1}, {1, 2, 3}}));
    REQUIRE(turned.size() == 1);
    CHECK(same(turned[0], 2, 1, 0, 3));
}

TEST_CASE("a second triangle wound the other way gives the same hinge", "[topology]")
{
    for (const auto& second : Triangles{{2, 1, 3}, {1, 2, 3}, {3, 2, 1}, {3, 1, 2}, {1, 3, 2}})
    {
        const auto hinges = mesh_hinges(mesh_of(4, {{0, 1, 2}, second}));
        REQUIRE(hinges.size() == 1);
        CHECK(same(hinges[0], 1, 2, 0, 3));
    }
}

TEST_CASE("the first triangle of a hinge is the one of the lower index", "[topology]")
{
    const auto hinges = mesh_hinges(mesh_of(4, {{2, 1, 3}, {0, 1, 2}}));
    REQUIRE(hinges.size() == 1);
    CHECK(same(hinges[0], 2, 1, 3, 0));
}

TEST_CASE("C01: three triangles on one edge give three hinges in ascending order", "[topology]")
{
    const auto hinges = mesh_hinges(mesh_of(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    REQUIRE(hinges.size() == 3);
    CHECK(same(hinges[0], 0, 1, 2, 3));
    CHECK(same(hinges[1], 0, 1, 2, 4));
    CHECK(same(hinges[2], 1, 0, 3, 4));
}

TEST_CASE("two triangles on the same corners have no angle and give no hinge", "[topology]")
{
    CHECK(mesh_hinges(mesh_of(3, {{0, 1, 2}, {0, 1, 2}})).empty());
    CHECK(mesh_hinges(mesh_of(3, {{0, 1, 2}, {2, 1, 0}})).empty());
}

TEST_CASE("a cut grid has the edges and hinges that counting gives", "[topology]")
{
    const std::uint32_t n = 64;
    const Mesh mesh = cut_grid(n, n);
    CHECK(mesh_edges(mesh).size() == 2 * n * (n - 1) + (n - 1) * (n - 1));
    CHECK(mesh_hinges(mesh).size() == 2 * (n - 1) * (n - 2) + (n - 1) * (n - 1));
}

TEST_CASE("a mesh that names no vertex or the same twice is refused with its place", "[topology]")
{
    std::string text;
    CHECK(code_of([] { mesh_edges(mesh_of(3, {{0, 1, 2}, {0, 1, 3}})); }, &text) == ErrorCode::bad_input);
    CHECK(text.find("triangles[1]") != std::string::npos);
    CHECK(text.find("vertex 3") != std::string::npos);
    CHECK(code_of([] { mesh_hinges(mesh_of(3, {{0, 1, 1}})); }) == ErrorCode::bad_input);
    Mesh chain = mesh_of(3, {{0, 1, 2}});
    chain.links = {{0, 1}, {2, 2}};
    CHECK(code_of([&] { mesh_edges(chain); }, &text) == ErrorCode::bad_input);
    CHECK(text.find("links[1]") != std::string::npos);
}

TEST_CASE("an edge with very many triangles has edges but is refused for bending", "[topology]")
{
    Mesh book = mesh_of(1003, {});
    for (std::uint32_t page = 0; page < 1001; ++page)
    {
        book.triangles.push_back({0, 1, 2 + page});
    }
    CHECK(mesh_edges(book).size() == 1 + 2 * 1001);
    CHECK(code_of([&] { mesh_hinges(book); }) == ErrorCode::limit);
    book.triangles.pop_back();
    CHECK(mesh_hinges(book).size() == 1000 * 999 / 2);
}
