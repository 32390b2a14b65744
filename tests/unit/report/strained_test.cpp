// Energy of what is strained (src/report/strained.hpp), as it is judged.

#include "support/catch.hpp"

#include "taut/report/soundness.hpp"

#include <algorithm>

using namespace taut;

TEST_CASE("a stiff solid that is squeezed by two percent has energy from nowhere, but where it touches")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 3, 3};
    body.material = solid_material();
    body.material.youngs_modulus = 1e9;
    body.transform.translate = {0, 3, 0};
    scene.bodies = {body};
    scene = resolve(scene);
    const std::vector<glm::dvec3>& rest = scene.bodies[0].mesh.positions;
    double lowest = rest[0].y;
    for (const glm::dvec3& p : rest)
        lowest = std::min(lowest, p.y);
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, lowest, 0};
    scene.colliders = {floor};
    const auto judged = [&](double squeezed, double from, double to) { // between these heights, m
        std::vector<glm::dvec3> x = rest;
        for (glm::dvec3& p : x)
            p.y -= squeezed * std::clamp(p.y - lowest - from, 0.0, to - from);
        const std::vector<glm::dvec3> still(x.size(), glm::dvec3(0));
        return judge_state(
            EnergyBudget(scene),
            RunState{scene, x, still, {1, 1.0 / 600, 9.81, true, 0}, Precision::float32, {}, 0});
    };
    const Soundness crushed = judged(0.02, 0, 1);
    CHECK(crushed.status == Status::unconverged);
    CHECK_THAT(crushed.reason, Contains("tetrahedra strained beyond a tenth of accept.stretch"));
    CHECK(judged(0.02, 1.0 / 3, 1).status == Status::unconverged);
    CHECK(judged(0.02, 0, 1.0 / 3).sound()); // the floor has pushed it last
    CHECK(judged(0.005, 0, 1).sound());      // nobody sees it
    scene.bodies[0].contact.self = true;
    CHECK(judged(0.02, 0, 1).sound()); // it may have pushed itself
}
