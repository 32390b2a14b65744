// Colliders that go through triangles.

#include "support/catch.hpp"

#include "taut/report/holes.hpp"

using namespace taut;

namespace {

/// A sheet of 1 m and a collider.
std::vector<SceneIssue> issues_of(std::uint32_t cells, const Collider& collider)
{
    Scene scene;
    Body body;
    body.name = "sheet";
    body.shape.cells = {cells, cells};
    scene.bodies = {body};
    scene.colliders = {collider};
    return holes_issues(resolve(scene));
}

} // namespace

TEST_CASE("a collider that fits through the triangles of a body is warned of, by its slimmest section")
{
    Collider ball, box, plane;
    ball.radius = 0.05;
    box.kind = ColliderKind::cuboid;
    plane.kind = ColliderKind::plane;
    CHECK(issues_of(8, ball).empty()); // by itself it meets triangles that it would fit through
    CHECK(issues_of(1, box).empty());
    ball.meets = box.meets = ColliderMeets::vertices;
    // The hole of a cell of length l is half its diagonal, 0.707 l.
    CHECK(issues_of(16, ball).empty());
    const std::vector<SceneIssue> found = issues_of(8, ball);
    REQUIRE(found.size() == 1);
    CHECK(!found[0].error);
    CHECK(found[0].field == "colliders[0]");
    CHECK_THAT(found[0].text,
               Contains("bodies[0] (sheet)") && Contains("0.05 m") && Contains("\"meets\": \"surface\""));
    box.half_size = {0.04, 0.5, 0.04}; // a post: 0.057 m round
    CHECK(issues_of(8, box).size() == 1);
    CHECK(issues_of(14, box).empty());
    box.half_size = {0.5, 0.001, 0.5}; // a plate
    CHECK(issues_of(4, box).empty());
    CHECK(issues_of(1, plane).empty());
}
