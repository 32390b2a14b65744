#include "support/catch.hpp"
#include "support/data.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/mesh.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

using namespace taut;

namespace {

double volume(const Mesh& mesh)
{
    double six = 0;
    for (const auto& t : mesh.tetrahedra)
        six += six_volumes(mesh.positions, t);
    return six / 6;
}

/// Every edge of the surface once each way: closed, and all triangles wound alike.
bool closed(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++sides[{t[k], t[(k + 1) % 3]}];
    return std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
        const auto other = sides.find({side.first.second, side.first.first});
        return side.second == 1 && other != sides.end() && other->second == 1;
    });
}

/// Volume within the surface, by the divergence theorem: positive when triangles face outwards.
double within(const Mesh& mesh)
{
    double six = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        six += glm::dot(mesh.positions[a], glm::cross(mesh.positions[b], mesh.positions[c]));
    return six / 6;
}

/// Volume to the cube of the root mean square edge, least over the tetrahedra; 1 = regular, 0 = flat.
double worst_quality(const Mesh& mesh)
{
    double worst = 1;
    for (const auto& t : mesh.tetrahedra)
    {
        double squares = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < i; ++j)
            {
                const glm::dvec3 edge = mesh.positions[t[i]] - mesh.positions[t[j]];
                squares += glm::dot(edge, edge) / 6;
            }
        worst = std::min(worst, std::sqrt(2.0) * six_volumes(mesh.positions, t) / std::pow(squares, 1.5));
    }
    return worst;
}

} // namespace

TEST_CASE(
    "a box has five or six tetrahedra a cell, all right-handed, and a closed surface that faces outwards")
{
    for (const bool five : {true, false})
    {
        CAPTURE(five);
        const Mesh box = make_box({3, 2, 4}, {1.5, 1, 2}, five);
        CHECK(box.positions.size() == 4 * 3 * 5);
        CHECK(box.tetrahedra.size() == (five ? 5u : 6u) * 24);
        for (const auto& t : box.tetrahedra)
            CHECK(six_volumes(box.positions, t) > 0);
        CHECK(volume(box) == Approx(3.0).epsilon(1e-12));
        CHECK(within(box) == Approx(3.0).epsilon(1e-12));
        CHECK(box.triangles.size() == 2 * 2 * (3 * 2 + 2 * 4 + 3 * 4));
        CHECK(closed(box));
    }
}

TEST_CASE("a ball's vertices lie on spheres, and its volume goes to that of the ball")
{
    double before = 1;
    for (const std::uint32_t cells : {4u, 8u, 16u})
    {
        const Mesh ball = make_ball(cells, 0.5);
        for (const auto& t : ball.tetrahedra)
            CHECK(six_volumes(ball.positions, t) > 0);
        for (const auto& t : ball.triangles)
            for (const std::uint32_t v : t)
                CHECK(glm::length(ball.positions[v]) == Approx(0.5).epsilon(1e-12));
        CHECK(closed(ball));
        CHECK(worst_quality(ball) > 0.5); // 1 = regular; 0.026 with 16 cells where edges of the cube lie flat
        const double error = 1 - volume(ball) / (4.0 / 3 * 3.14159265358979 * 0.125);
        CHECK(error > 0);
        CHECK(error < 0.4 * before); // second order: a quarter
        before = error;
    }
}

TEST_CASE("tetrahedra of a file are turned, stray vertices dropped, flat ones refused by number")
{
    std::vector<glm::dvec3> x = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
    MeshFindings findings;
    const Mesh mesh = solid_mesh(x, {{1, 3, 2, 4}}, "test", findings);
    CHECK(findings.turned_tetrahedra == 1);
    CHECK(findings.unused_vertices == 2);
    CHECK(mesh.positions.size() == 4);
    CHECK(six_volumes(mesh.positions, mesh.tetrahedra[0]) > 0);
    CHECK(mesh.triangles.size() == 4);
    try
    {
        solid_mesh(x, {{1, 2, 3, 4}, {1, 2, 3, 5}}, "flat.mesh", findings);
        FAIL("a flat tetrahedron was taken");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::degenerate_rest);
        CHECK_THAT(error.what(), Contains("flat.mesh: tetrahedron 1 (vertices 1, 2, 3, 5"));
    }
}

TEST_CASE("a solid of a scene has its own defaults, its own keys, and faces to pin")
{
    const Scene scene = resolve(parse_scene(
        R"({"taut": 1,
            "bodies": [{"box": {"cells": [2, 3, 4], "size": [1, 2, 3]}, "pins": [{"face": "top"}]}]})"));
    const Body& body = scene.bodies[0];
    CHECK(body.material.density == 1000);
    CHECK(body.material.youngs_modulus == 1e5);
    CHECK(body.material.stretch_stiffness == 0);
    REQUIRE(body.pins.size() == 1);
    CHECK(body.pins[0].vertices.size() == 3 * 5);
    for (const std::uint32_t v : body.pins[0].vertices)
        CHECK(body.mesh.positions[v].y == 1);
    const auto refused = [](const std::string& text, const std::string& word) {
        CHECK_THROWS_WITH(resolve(parse_scene(text)), Contains(word));
    };
    refused(R"({"taut": 1, "bodies": [{"box": {}, "material": {"stretch_stiffness": 1}}]})",
            "unknown key \"stretch_stiffness\"");
    refused(R"({"taut": 1, "bodies": [{"box": {}, "material": {"poissons_ratio": 0.5}}]})", "less than 0.5");
    refused(R"({"taut": 1, "bodies": [{"ball": {"cells": 1}}]})", "it must be 2 or more");
    refused(R"({"taut": 1, "bodies": [{"grid": {}, "pins": [{"face": "top"}]}]})",
            "only a box has; use \"edges\", \"corners\"");
    refused(R"({"taut": 1, "bodies": [{"box": {}, "pins": [{"corner": "top_left"}]}]})", "use \"faces\"");
}

TEST_CASE("the cow of the data folder is read with all its tetrahedra")
{
    const auto file = find_data("tets/spot_tet.mesh");
    if (!file)
        return;
    MeshFindings findings;
    const Mesh mesh = read_tetrahedra(*file, &findings);
    CHECK(mesh.positions.size() == 2304);
    CHECK(mesh.tetrahedra.size() == 8103);
    CHECK(mesh.triangles.size() == 3318);
    CHECK(volume(mesh) == Approx(0.6775).epsilon(1e-3));
    CHECK(closed(mesh));
}
