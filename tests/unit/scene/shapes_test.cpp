#include "support/catch.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/mesh.hpp"

#include <glm/geometric.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

using namespace taut;

namespace {

double area(const Mesh& mesh)
{
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += 0.5 * glm::length(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                            mesh.positions[t[2]] - mesh.positions[t[0]]));
    return sum;
}

} // namespace

TEST_CASE("a grid goes row by row from the top left")
{
    const Mesh mesh = make_grid(3, 2, 6, 4, true);
    CHECK(mesh.grid_columns == 4);
    CHECK(mesh.grid_rows == 3);
    REQUIRE(mesh.positions.size() == 12);
    CHECK(mesh.positions[0] == glm::dvec3(-3, 2, 0));
    CHECK(mesh.positions[1] == glm::dvec3(-1, 2, 0));
    CHECK(mesh.positions[3] == glm::dvec3(3, 2, 0));
    CHECK(mesh.positions[4] == glm::dvec3(-3, 0, 0));
    CHECK(mesh.positions[11] == glm::dvec3(3, -2, 0));
    CHECK(mesh.links.empty());
}

TEST_CASE("the triangles of a grid cover it once and face +z")
{
    for (const bool alternating : {true, false})
    {
        const Mesh mesh = make_grid(5, 4, 1, 2, alternating);
        REQUIRE(mesh.triangles.size() == 40);
        CHECK(area(mesh) == Approx(2).epsilon(1e-14));
        for (const auto& t : mesh.triangles)
            CHECK(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                             mesh.positions[t[2]] - mesh.positions[t[0]])
                      .z > 0);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed;
        for (const auto& t : mesh.triangles)
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(++directed[{t[c], t[(c + 1) % 3]}] == 1);
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const auto& [edge, n] : directed)
            edges.insert(std::minmax(edge.first, edge.second));
        CHECK(edges.size() == 5 * 5 + 6 * 4 + 20); // along, down, diagonal
    }
}

TEST_CASE("alternating diagonals meet like a union jack, uniform ones are parallel")
{
    const auto slopes = [](const Mesh& mesh) {
        std::map<bool, int> count; // rising to the right
        for (const auto& t : mesh.triangles)
            for (std::size_t c = 0; c < 3; ++c)
            {
                const glm::dvec3 d = mesh.positions[t[(c + 1) % 3]] - mesh.positions[t[c]];
                if (d.x != 0 && d.y != 0)
                    ++count[d.x * d.y > 0];
            }
        return count;
    };
    CHECK(slopes(make_grid(4, 4, 1, 1, true)) == std::map<bool, int>{{false, 16}, {true, 16}});
    CHECK(slopes(make_grid(4, 4, 1, 1, false)) == std::map<bool, int>{{false, 32}});
    // The inner vertex at (1, 1) of a 2 x 2 grid is an end of all four diagonals.
    int at_centre = 0;
    for (const auto& t : make_grid(2, 2, 1, 1, true).triangles)
        at_centre += t[0] == 4 || t[1] == 4 || t[2] == 4;
    CHECK(at_centre == 8);
}

TEST_CASE("a grid is its own mirror image to the last bit")
{
    const Mesh mesh = make_grid(7, 3, 0.7, 0.3, true);
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t column = 0; column < 8; ++column)
            CHECK(mesh.positions[row * 8 + column].x == -mesh.positions[row * 8 + 7 - column].x);
}

TEST_CASE("a chain hangs down from the origin")
{
    const Mesh mesh = make_chain(4, 2, 0.05);
    REQUIRE(mesh.positions.size() == 5);
    CHECK(mesh.positions[0] == glm::dvec3(0));
    CHECK(mesh.positions[3] == glm::dvec3(0, -1.5, 0));
    CHECK(mesh.positions[4] == glm::dvec3(0, -2, 0));
    CHECK(mesh.links == std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    CHECK(mesh.link_width == 0.05);
    CHECK(mesh.triangles.empty());
    CHECK(make_chain(0, 1, 0.01).positions.size() == 1);
}

TEST_CASE("a written OBJ is read back, and no temporary file stays")
{
    const Temporary folder;
    const std::filesystem::path file = folder.path / "grid.obj";
    Mesh mesh = make_grid(9, 5, 1, 0.3, true);
    for (glm::dvec3& p : mesh.positions)
        p += glm::dvec3(1.0 / 3, -1e-7, 12345.678);
    write_obj(file, mesh);
    write_obj(file, mesh); // also over an existing file
    const Mesh again = read_mesh(file, -1);
    CHECK(again.triangles == mesh.triangles);
    REQUIRE(again.positions.size() == mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        for (int c = 0; c < 3; ++c)
            CHECK(static_cast<float>(again.positions[v][c]) == static_cast<float>(mesh.positions[v][c]));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
}

TEST_CASE("the links of a chain are written as lines")
{
    const Temporary folder;
    write_obj(folder.path / "chain.obj", make_chain(2, 1, 0.01));
    std::ifstream stream(folder.path / "chain.obj");
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    CHECK(text == "v 0 0 0\nv 0 -0.5 0\nv 0 -1 0\nl 1 2\nl 2 3\n");
}

TEST_CASE("a file that cannot be written is an error that names it")
{
    const Temporary folder;
    try
    {
        write_obj(folder.path / "missing" / "a.obj", make_chain(1, 1, 0.01));
        FAIL("no error");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::io);
        CHECK(std::string(error.what()).find("a.obj") != std::string::npos);
    }
}
