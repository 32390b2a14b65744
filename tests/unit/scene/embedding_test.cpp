#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sphere.hpp"
#include "unit/scene/temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/embedding.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>

using namespace taut;

namespace {

Mesh points(const std::vector<glm::dvec3>& x)
{
    Mesh mesh;
    mesh.positions = x;
    return mesh;
}

std::array<glm::dvec3, 4> corners(const Mesh& solid, std::uint32_t t)
{
    const auto& c = solid.tetrahedra[t];
    const auto& x = solid.positions;
    return {x[c[0]], x[c[1]], x[c[2]], x[c[3]]};
}

/// By looking at every tetrahedron: the distance to the point of the weights, negative ones taken for 0.
double distance_to(const Mesh& solid, std::uint32_t t, const glm::dvec3& p)
{
    const auto x = corners(solid, t);
    const glm::dvec3 w = glm::inverse(glm::dmat3(x[1] - x[0], x[2] - x[0], x[3] - x[0])) * (p - x[0]);
    glm::dvec4 all(1 - w.x - w.y - w.z, w.x, w.y, w.z);
    all = glm::max(all, glm::dvec4(0));
    all /= all.x + all.y + all.z + all.w;
    return glm::distance(p, all.x * x[0] + all.y * x[1] + all.z * x[2] + all.w * x[3]);
}

double largest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double worst = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        worst = std::max(worst, glm::distance(a[v], b[v]));
    return worst;
}

} // namespace

TEST_CASE("a fine ball in a coarse box is held, and any linear map carries it over", "[embedded]")
{
    const Mesh box = make_box({3, 4, 2}, {2, 2.4, 2.2}, true);
    const Mesh ball = test::sphere_mesh(16, 0.9);
    EmbeddingFindings findings;
    const Embedding e = embed(ball, box, &findings);
    REQUIRE(e.used());
    REQUIRE(e.weights.size() == ball.positions.size());
    CHECK(findings.outside == 0);
    CHECK(findings.far == 0);
    for (std::size_t v = 0; v < e.weights.size(); ++v)
    {
        const glm::dvec4& w = e.weights[v];
        CHECK(std::min({w.x, w.y, w.z, w.w}) > -1e-12);
        CHECK(std::abs(w.x + w.y + w.z + w.w - 1) < 1e-15);
    }
    CHECK(largest(carry(e, box, box.positions), ball.positions) < 1e-14);
    const glm::dmat3 map(1.2, 0.3, -0.4, 0.1, 0.8, 0.5, -0.7, 0.2, 1.5);
    const glm::dvec3 shift(3, -2, 5);
    std::vector<glm::dvec3> moved = box.positions, expected = ball.positions;
    for (glm::dvec3& x : moved)
        x = map * x + shift;
    for (glm::dvec3& x : expected)
        x = map * x + shift;
    CHECK(largest(carry(e, box, moved), expected) < 1e-12);
}

TEST_CASE("vertices outside hang on the nearest tetrahedron, and linear maps carry them over as well",
          "[embedded]")
{
    const Mesh solid = make_ball(6, 1);
    conformance::Random random(31);
    std::vector<glm::dvec3> x;
    for (int k = 0; k < 400; ++k)
        x.emplace_back(random.uniform(-1.6, 1.6), random.uniform(-1.6, 1.6), random.uniform(-1.6, 1.6));
    x.emplace_back(40, -20, 10);
    EmbeddingFindings findings;
    const Embedding e = embed(points(x), solid, &findings);
    std::size_t outside = 0;
    for (std::uint32_t v = 0; v < x.size(); ++v)
    {
        double nearest = 1e300;
        for (std::uint32_t t = 0; t < solid.tetrahedra.size(); ++t)
            nearest = std::min(nearest, distance_to(solid, t, x[v]));
        CHECK(distance_to(solid, e.tetrahedron[v], x[v]) == Approx(nearest).margin(1e-12));
        outside += nearest > 1e-12;
    }
    CHECK(outside > 100);
    CHECK(findings.outside == outside);
    CHECK(findings.far >= 1);
    CHECK(largest(carry(e, solid, solid.positions), x) < 1e-10);
    std::vector<glm::dvec3> moved = solid.positions, expected = x;
    for (auto* all : {&moved, &expected})
        for (glm::dvec3& p : *all)
            p = glm::dvec3(p.y, -2.0 * p.x, p.z + 0.5 * p.y);
    CHECK(largest(carry(e, solid, moved), expected) < 1e-10);
}

TEST_CASE("many vertices in many tetrahedra are found by a grid", "[embedded]")
{
    const Mesh box = make_box({22, 22, 22}, {2, 2, 2}, true); // 53,240 tetrahedra
    const Mesh ball = test::sphere_mesh(112, 0.97);           // 50,178 vertices
    CHECK(box.tetrahedra.size() > 50000);
    CHECK(ball.positions.size() > 50000);
    const auto start = std::chrono::steady_clock::now();
    EmbeddingFindings findings;
    const Embedding e = embed(ball, box, &findings);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (std::getenv("TAUT_NOTES"))
        std::cout << "embedded | 50,178 vertices in 53,240 tetrahedra | s | " << seconds << '\n';
    CHECK(findings.outside == 0);
    CHECK(largest(carry(e, box, box.positions), ball.positions) < 1e-13);
}

TEST_CASE("a scene with an embedded surface resolves, and shows it in place of its tetrahedra", "[embedded]")
{
    const Temporary folder;
    write_obj(folder.path / "fine.obj", test::sphere_mesh(6, 0.4));
    const char* text = R"({"taut": 1, "bodies": [
        {"grid": {"cells": [2, 2]}},
        {"ball": {"cells": 4, "radius": 0.5}, "embedded": "fine.obj",
         "transform": {"translate": [1, 2, 3], "scale": 2}}]})";
    std::vector<SceneIssue> warnings;
    const Scene scene = resolve(parse_scene(text, folder.path), &warnings);
    CHECK(warnings.empty());
    CHECK(any_embedding(scene));
    REQUIRE(scene.bodies[1].embedding.used());
    CHECK(scene.bodies[1].embedding.surface.positions.size() == 146);
    double reach = 0;
    for (const glm::dvec3& x : scene.bodies[1].embedding.surface.positions)
        reach = std::max(reach, glm::distance(x, glm::dvec3(1, 2, 3)));
    CHECK(reach == Approx(0.8));
    const Scene shown = shown_scene(scene);
    CHECK(shown.bodies[0].mesh.positions.size() == 9);
    CHECK(shown.bodies[1].mesh.positions.size() == 146);
    CHECK(shown.bodies[1].mesh.tetrahedra.empty());
    CHECK(!any_embedding(shown));
    std::vector<glm::dvec3> places = scene.bodies[0].mesh.positions;
    for (const glm::dvec3& x : scene.bodies[1].mesh.positions)
        places.push_back(x + glm::dvec3(0, 10, 0));
    const std::vector<glm::dvec3> seen = shown_positions(scene, places);
    REQUIRE(seen.size() == 9 + 146);
    for (std::size_t v = 0; v < 9; ++v)
        CHECK(seen[v] == places[v]);
    for (std::size_t v = 0; v < 146; ++v)
        CHECK(glm::distance(seen[9 + v],
                            scene.bodies[1].embedding.surface.positions[v] + glm::dvec3(0, 10, 0)) < 1e-12);
    // Resolving twice is resolving once.
    CHECK(resolve(scene).bodies[1].embedding.weights == scene.bodies[1].embedding.weights);
}

TEST_CASE("an embedded surface that cannot be is refused by its field", "[embedded]")
{
    const Temporary folder;
    const auto parsed = [&](const std::string& body) {
        return parse_scene(R"({"taut": 1, "bodies": [)" + body + "]}", folder.path);
    };
    const Scene cloth = parsed(R"({"grid": {}, "embedded": "fine.obj"})");
    CHECK_THROWS_WITH(resolve(cloth), Contains("bodies[0].embedded") && Contains("only solids"));
    const Scene missing = parsed(R"({"box": {}, "embedded": "fine.obj"})");
    CHECK_THROWS_WITH(resolve(missing), Contains("bodies[0].embedded") && Contains("fine.obj"));
    try
    {
        resolve(missing);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::io);
    }
    CHECK_THROWS_WITH(parsed(R"({"box": {}, "embedded": ""})"), Contains("bodies[0].embedded"));
    // In the wrong unit: a warning that names the first vertex.
    write_obj(folder.path / "fine.obj", test::sphere_mesh(2, 40));
    std::vector<SceneIssue> warnings;
    resolve(missing, &warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(!warnings[0].error);
    CHECK(warnings[0].field == "bodies[0].embedded");
    CHECK_THAT(warnings[0].text, Contains("18 vertices") && Contains("vertex 0"));
}
