// Which bodies a collider meets by their triangles.

#include "support/catch.hpp"

#include "taut/scene/faces.hpp"

using namespace taut;

namespace {

/// A square metre of cloth; the hole of a cell of length l is half its diagonal, 0.707 l.
Body sheet(std::uint32_t cells)
{
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].shape.cells = {cells, cells};
    return resolve(scene).bodies[0];
}

Collider of_kind(ColliderKind kind, double radius = 0.5)
{
    Collider out;
    out.kind = kind;
    out.radius = radius;
    return out;
}

} // namespace

TEST_CASE("by itself a collider meets triangles between whose corners it would stand out", "[face]")
{
    Body coarse = sheet(4); // a hole of 0.177
    CHECK(largest_hole(coarse) == Approx(0.25 * std::sqrt(0.5)));
    CHECK(meets_surface(coarse, of_kind(ColliderKind::cuboid)));
    CHECK(meets_surface(coarse, of_kind(ColliderKind::sphere, 0.1)));
    CHECK(meets_surface(coarse, of_kind(ColliderKind::sphere, 0.3)));
    CHECK(!meets_surface(coarse, of_kind(ColliderKind::sphere, 0.5)));
    CHECK(meets_surface(coarse, of_kind(ColliderKind::capsule, 0.3)));
    CHECK(!meets_surface(coarse, of_kind(ColliderKind::capsule, 0.5)));
    CHECK(!meets_surface(coarse, of_kind(ColliderKind::plane)));
    CHECK(!meets_surface(coarse, of_kind(ColliderKind::distance_field)));
    coarse.material.thickness = 0.15; // which keeps it off by more than it would stand out
    CHECK(!meets_surface(coarse, of_kind(ColliderKind::cuboid)));
}

TEST_CASE("a collider that says what it meets meets that", "[face]")
{
    const Body fine = sheet(64);
    Collider ball = of_kind(ColliderKind::sphere), box = of_kind(ColliderKind::cuboid);
    CHECK(!meets_surface(fine, ball));
    ball.meets = ColliderMeets::surface;
    CHECK(meets_surface(fine, ball));
    box.meets = ColliderMeets::vertices;
    CHECK(!meets_surface(fine, box));
    Body led = fine;
    led.kinematic.used = true;
    CHECK(!meets_surface(led, ball));
}

TEST_CASE("what a collider meets is told in the scene file by one of three words", "[face]")
{
    const std::string scene = R"({"taut": 1, "duration": 1, "bodies": [{"grid": {"cells": [2, 2]}}],
        "colliders": [{"sphere": {}, "meets": ")";
    CHECK(parse_scene(scene + "surface\"}]}").colliders[0].meets == ColliderMeets::surface);
    CHECK_THROWS_WITH(parse_scene(scene + "faces\"}]}"),
                      Contains("colliders[0].meets is \"faces\"") && Contains("\"vertices\""));
}

TEST_CASE("a distance field cannot be told to meet triangles", "[face]")
{
    Scene scene;
    Collider field = of_kind(ColliderKind::distance_field);
    field.field_file = "ring.sdf";
    field.meets = ColliderMeets::surface;
    scene.colliders = {field};
    scene.bodies.resize(1);
    const std::vector<SceneIssue> issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].error);
    CHECK(issues[0].field == "colliders[0].meets");
    CHECK_THAT(issues[0].text, Contains("kinematic"));
}
