// Edges, hinges and vertex order, on meshes small enough to check by eye and on real ones.

#include "support/catch.hpp"
#include "taut/plan/topology.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <sstream>

using namespace taut;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Mesh mesh_of(std::size_t vertices, Triangles triangles)
{
    Mesh mesh;
    mesh.positions.resize(vertices, glm::dvec3(0));
    mesh.triangles = std::move(triangles);
    return mesh;
}

Mesh tetrahedron_surface() { return mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}); }

/// columns x rows vertices, each cell cut along the same diagonal.
Mesh cut_grid(std::uint32_t columns, std::uint32_t rows)
{
    Mesh mesh;
    for (std::uint32_t y = 0; y < rows; ++y)
    {
        for (std::uint32_t x = 0; x < columns; ++x)
        {
            mesh.positions.emplace_back(x, y, 0);
            if (x + 1 < columns && y + 1 < rows)
            {
                const std::uint32_t v = y * columns + x;
                mesh.triangles.push_back({v, v + 1, v + columns + 1});
                mesh.triangles.push_back({v, v + columns + 1, v + columns});
            }
        }
    }
    return mesh;
}

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

std::filesystem::path data_folder()
{
    const char* named = std::getenv("TAUT_DATA");
    return named != nullptr ? std::filesystem::path(named)
                            : std::filesystem::path(TAUT_SOURCE_DIR) / ".." / "shared" / "data";
}

/// A reader for the tests alone, so that they do not depend on the scene's: OFF and OBJ triangles.
bool read_triangles(const std::string& name, Mesh& mesh)
{
    const auto path = data_folder() / "meshes" / name;
    std::ifstream in(path);
    if (!in)
    {
        WARN("skipped: " << path << " is missing");
        return false;
    }
    std::string word, line;
    if (path.extension() == ".off")
    {
        std::size_t vertices = 0, faces = 0, edges = 0, corners = 0;
        in >> word >> vertices >> faces >> edges;
        mesh.positions.resize(vertices);
        mesh.triangles.resize(faces);
        for (auto& p : mesh.positions)
        {
            in >> p.x >> p.y >> p.z;
        }
        for (auto& t : mesh.triangles)
        {
            in >> corners >> t[0] >> t[1] >> t[2];
        }
        return true;
    }
    while (std::getline(in, line))
    {
        std::istringstream words(line);
        glm::dvec3 p;
        std::array<std::uint32_t, 3> t{};
        words >> word;
        if (word == "v" && words >> p.x >> p.y >> p.z)
        {
            mesh.positions.push_back(p);
        }
        else if (word == "f")
        {
            for (auto& corner : t)
            {
                words >> word;
                corner = static_cast<std::uint32_t>(std::stoul(word) - 1);
            }
            mesh.triangles.push_back(t);
        }
    }
    return true;
}

ConstraintGraph graph_of(const std::vector<MeshEdge>& edges, std::size_t vertices)
{
    ConstraintGraph graph{static_cast<std::uint32_t>(vertices), 2, {}, {}};
    for (const MeshEdge& e : edges)
    {
        graph.vertices.insert(graph.vertices.end(), {e.a, e.b});
    }
    return graph;
}

ConstraintGraph graph_of(const std::vector<Hinge>& hinges, std::size_t vertices)
{
    ConstraintGraph graph{static_cast<std::uint32_t>(vertices), 4, {}, {}};
    for (const Hinge& h : hinges)
    {
        graph.vertices.insert(graph.vertices.end(), {h.edge0, h.edge1, h.wing0, h.wing1});
    }
    return graph;
}

std::uint32_t degree_of(const ConstraintGraph& graph)
{
    std::vector<std::uint32_t> degree(graph.vertex_count, 0);
    for (const std::uint32_t v : graph.vertices)
    {
        ++degree[v];
    }
    return *std::max_element(degree.begin(), degree.end());
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

TEST_CASE("the vertex order of a square follows the Z of the Morton curve", "[topology]")
{
    std::vector<glm::dvec3> positions;
    for (int y = 0; y < 4; ++y)
    {
        for (int x = 0; x < 4; ++x)
        {
            positions.emplace_back(x, y, 7);
        }
    }
    const std::vector<std::uint32_t> expected = {0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15};
    CHECK(locality_order(positions) == expected);
}

TEST_CASE("points on a line come out in order, whichever axis it follows", "[topology]")
{
    std::vector<std::uint32_t> ranks(1000);
    std::iota(ranks.begin(), ranks.end(), 0u);
    std::shuffle(ranks.begin(), ranks.end(), std::mt19937(4));
    for (int axis = 0; axis < 3; ++axis)
    {
        std::vector<glm::dvec3> positions(ranks.size(), glm::dvec3(-5));
        for (std::size_t i = 0; i < ranks.size(); ++i)
        {
            positions[i][axis] = 0.001 * ranks[i];
        }
        const auto order = locality_order(positions);
        CHECK(std::is_sorted(order.begin(), order.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return ranks[a] < ranks[b]; }));
    }
}

TEST_CASE("the vertex order keeps equal points in order and is a permutation of any input", "[topology]")
{
    const std::vector<glm::dvec3> equal(50, glm::dvec3(3, -2, 1));
    std::vector<std::uint32_t> identity(50);
    std::iota(identity.begin(), identity.end(), 0u);
    CHECK(locality_order(equal) == identity);
    CHECK(locality_order({}).empty());

    using Limits = std::numeric_limits<double>;
    const double nan = Limits::quiet_NaN(), inf = Limits::infinity(), huge = Limits::max();
    const double tiny = Limits::denorm_min();
    const std::vector<double> values = {0, -0.0, 1, -1e300, huge, -huge, tiny, nan, inf, -inf};
    std::vector<glm::dvec3> hostile;
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i)
    {
        hostile.emplace_back(values[random() % 10], values[random() % 10], values[random() % 10]);
    }
    auto order = locality_order(hostile);
    std::sort(order.begin(), order.end());
    identity.resize(200);
    std::iota(identity.begin(), identity.end(), 0u);
    CHECK(order == identity);
}

TEST_CASE("the vertex order does not depend on position or unit, nor on noise across a sheet", "[topology]")
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<glm::dvec3> sheet, moved, noisy;
    for (int i = 0; i < 2000; ++i)
    {
        // Multiples of 1/4096, so that scaling by a power of two and the shift are exact.
        const glm::dvec3 p(std::floor(unit(random) * 4096) / 4096, std::floor(unit(random) * 4096) / 4096, 0);
        sheet.push_back(p);
        moved.push_back(1024.0 * p + glm::dvec3(64, -32, 8));
        noisy.push_back(p + glm::dvec3(0, 0, 1e-9 * unit(random)));
    }
    CHECK(locality_order(moved) == locality_order(sheet));
    CHECK(locality_order(noisy) == locality_order(sheet));
}

TEST_CASE("the vertex order shortens the jumps along the edges of a shuffled sheet", "[topology]")
{
    const std::uint32_t n = 64;
    const Mesh mesh = cut_grid(n, n);
    std::vector<std::uint32_t> shuffled(n * n), place(n * n);
    std::iota(shuffled.begin(), shuffled.end(), 0u);
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(2));
    std::vector<glm::dvec3> positions(n * n);
    for (std::uint32_t i = 0; i < n * n; ++i)
    {
        positions[shuffled[i]] = mesh.positions[i];
    }
    const auto order = locality_order(positions);
    for (std::uint32_t i = 0; i < n * n; ++i)
    {
        place[order[i]] = i;
    }
    std::size_t near = 0, near_before = 0, total = 0;
    for (const MeshEdge& e : mesh_edges(mesh))
    {
        const auto jump = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
        near += jump(place[shuffled[e.a]], place[shuffled[e.b]]) <= 16;
        near_before += jump(shuffled[e.a], shuffled[e.b]) <= 16;
        ++total;
    }
    CHECK(near * 3 > total * 2);
    CHECK(near_before * 10 < total);
}

TEST_CASE("real meshes have the edges that their description counts", "[topology][data]")
{
    struct Row
    {
        const char* file;
        std::size_t edges, boundary;
    };
    for (const Row& row : {Row{"armadillo.off", 78000, 0}, Row{"skirt_seamless_20k_cm.obj", 30597, 1197},
                           Row{"dress_stage.obj", 45098, 1828}, Row{"elephant-with-holes.off", 7371, 1353},
                           Row{"skirt8K.obj", 23979, 384}})
    {
        Mesh mesh;
        if (!read_triangles(row.file, mesh))
        {
            return;
        }
        INFO(row.file);
        const auto edges = mesh_edges(mesh);
        CHECK(edges.size() == row.edges);
        const auto boundary = std::count_if(edges.begin(), edges.end(),
                                            [](const MeshEdge& e) { return e.triangles.size() == 1; });
        CHECK(static_cast<std::size_t>(boundary) == row.boundary);
        CHECK(mesh_hinges(mesh).size() == row.edges - row.boundary);
    }
}

TEST_CASE("a real garment needs few colours, none of them small", "[topology][colouring][data]")
{
    Mesh mesh;
    if (!read_triangles("skirt_seamless_20k_cm.obj", mesh))
    {
        return;
    }
    for (const auto& graph : {graph_of(mesh_edges(mesh), mesh.positions.size()),
                              graph_of(mesh_hinges(mesh), mesh.positions.size())})
    {
        const Colouring plain = colour_greedy(graph, {64, false}), even = colour_greedy(graph);
        std::string why;
        CHECK(valid(plain, graph, &why));
        CHECK(why.empty());
        REQUIRE(valid(even, graph, &why));
        CHECK(even.hubs.empty());
        CHECK(even.colour_count() <= plain.colour_count());
        CHECK(even.colour_count() >= degree_of(graph));
        CHECK(even.colour_count() <= degree_of(graph) + 1);
        for (std::size_t k = 0; k < even.colour_count(); ++k)
        {
            const std::uint32_t size = even.colour_start[k + 1] - even.colour_start[k];
            CHECK(size * even.colour_count() > graph.size() * 9 / 10);
        }
    }
}
