#include "taut/report/crossing.hpp"

#include "support/catch.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace {

using namespace taut;

Collider ball(double radius)
{
    Collider out;
    out.radius = radius;
    return out;
}

Collider box(const glm::dvec3& half)
{
    Collider out;
    out.kind = ColliderKind::cuboid;
    out.half_size = half;
    return out;
}

Collider capsule(double radius, double half_length)
{
    Collider out = ball(radius);
    out.kind = ColliderKind::capsule;
    out.point = {0, -half_length, 0};
    out.end = {0, half_length, 0};
    return out;
}

/// Equilateral, of corners at `around` from the middle, in the plane of height y.
TriangleCorners flat(double y, double around)
{
    const double s = std::sqrt(0.75) * around;
    return {glm::dvec3(around, y, 0), glm::dvec3(-around / 2, y, s), glm::dvec3(-around / 2, y, -s)};
}

TriangleCorners link(const glm::dvec3& a, const glm::dvec3& b) { return {a, b, b}; }

/// One triangle as a body, moved as told; three looks a collider's size apart would miss nothing.
struct Watched
{
    Scene scene;
    CrossingWatch watch;
    std::uint64_t frame = 0;

    Watched(const TriangleCorners& corners, const Collider& collider)
        : scene(make(corners, collider)),
          watch(scene)
    {}

    static Scene make(const TriangleCorners& corners, const Collider& collider)
    {
        Scene scene;
        scene.bodies.resize(1);
        scene.bodies[0].name = "cloth";
        scene.bodies[0].mesh.positions.assign(corners.begin(), corners.end());
        scene.bodies[0].mesh.triangles = {{0, 1, 2}};
        scene.colliders = {collider};
        scene.colliders[0].name = "thing";
        return scene;
    }
    const Crossings& look(double time, const TriangleCorners& at, const glm::dvec3& velocity = glm::dvec3(0))
    {
        const std::vector<glm::dvec3> v(3, velocity);
        watch.look(frame++, time, 1.0 / 600, at, v);
        return watch.found();
    }
};

TEST_CASE("the depth of an element is that of its deepest point, which need not be a vertex")
{
    const SolidShape round = solid_shape(ball(1));
    CHECK(depth_of(round, flat(0.25, 3)) == Approx(0.75)); // its middle is nearest
    CHECK(depth_of(round, link({0.5, -3, 0}, {0.5, 3, 0})) == Approx(0.5));
    CHECK(depth_of(round, flat(1.5, 3)) == 0);
    CHECK(depth_of(round, {glm::dvec3(0.8, 0, 0), glm::dvec3(4, 1, 0), glm::dvec3(4, -1, 0)}) ==
          Approx(0.2)); // a corner
    const SolidShape stick = solid_shape(capsule(0.1, 1));
    CHECK(depth_of(stick, flat(0.5, 2)) == Approx(0.1)); // the axis goes through it
    CHECK(depth_of(stick, link({0.06, 0.3, -2}, {0.06, 0.3, 2})) == Approx(0.04));
    CHECK(depth_of(stick, flat(1.07, 2)) == Approx(0.03));                     // above the end
    CHECK(depth_of(stick, link({0.05, -5, 0}, {0.05, 5, 0})) == Approx(0.05)); // along the axis
    const SolidShape plate = solid_shape(box({1, 0.1, 1}));
    CHECK(depth_of(plate, link({0, -1, 0}, {0, 1, 0})) == Approx(0.1).epsilon(1e-4));
    CHECK(depth_of(plate, flat(0.08, 5)) == Approx(0.02).epsilon(1e-4));
    CHECK(depth_of(plate, link({0.9, 1, 0}, {3, -1.1, 0})) == 0); // past the rim, though its bounds meet
}

TEST_CASE("elements that lie on a collider are not deep in it, however round it is")
{
    const SolidShape round = solid_shape(ball(1));
    for (const double edge : {0.2, 0.8, 1.4})
    {
        INFO(edge);
        const double around = edge / std::sqrt(3.0);
        CHECK_FALSE(lies_deep(round, flat(std::sqrt(1 - around * around), around), edge));
    }
    CHECK(lies_deep(round, flat(std::sqrt(1 - 0.9 * 0.9), 0.9), 0.9 * std::sqrt(3.0))); // edges of 1.56
    const SolidShape cube = solid_shape(box({1, 1, 1}));
    CHECK_FALSE(lies_deep(cube, link({1, 0.05, 0}, {0.05, 1, 0}), 1.35)); // over an edge
    CHECK(lies_deep(cube, link({1, -0.1, 0}, {-0.1, 1, 0}), 1.56));
}

TEST_CASE("cloth over the rim of a thin plate cuts it and is not deep; in its middle it is")
{
    const SolidShape plate = solid_shape(box({1, 0.01, 1}));
    CHECK_FALSE(lies_deep(plate, link({0.9, 0.02, 0}, {0.95, -0.05, 0}), 0.1));
    CHECK(lies_deep(plate, link({0.3, 0.02, 0}, {0.35, -0.05, 0}), 0.1));
}

TEST_CASE("a point goes through a moving triangle when it meets it within its edges")
{
    const glm::dvec3 p(0);
    CHECK(goes_through(p, flat(1, 1), flat(-1, 1)));
    CHECK(goes_through(p, flat(1, 1), flat(0, 1)));        // ends on it
    CHECK_FALSE(goes_through(p, flat(0, 1), flat(-1, 1))); // begins on it
    CHECK_FALSE(goes_through(p, flat(1, 1), flat(0.01, 1)));
    TriangleCorners aside = flat(1, 1), aside_after = flat(-1, 1);
    for (TriangleCorners* c : {&aside, &aside_after})
        for (glm::dvec3& q : *c)
            q.x += 1.01;
    CHECK_FALSE(goes_through(p, aside, aside_after));
    // Past it and back within the interval: turned over about an axis that holds the point's far side.
    TriangleCorners there = flat(0.2, 1), back = flat(0.2, 1);
    back[0].y = there[0].y = -0.2; // tilted; the plane is 0.0667 above the point
    CHECK_FALSE(goes_through(p, there, back));
    back[0].y = -1.2; // the corner drops: the plane passes the point
    CHECK(goes_through(p, there, back));
    CHECK_FALSE(goes_through(p, link({-1, 1, 0}, {1, 1, 0}), link({-1, -1, 0}, {1, -1, 0})));
}

TEST_CASE("a link goes through a bar when it meets the axis, whatever the bar is made of")
{
    const auto through = [](const SolidShape& shape, const TriangleCorners& before,
                            const TriangleCorners& after) {
        return link_goes_through(shape, 0.1, before, after);
    };
    const auto across = [](double y, double z) { return link({0.05, z, y}, {-0.05, z, y}); }; // of an axis y
    for (const SolidShape& bar : {solid_shape(capsule(0.02, 1)), solid_shape(box({0.02, 1, 0.02}))})
    {
        CHECK(through(bar, across(0.05, 0.3), across(-0.05, 0.3)));
        CHECK(through(bar, across(0.05, 0.3), link({0.05, 0.3, 0.02}, {-0.05, 0.3, -0.06}))); // tilted
        CHECK_FALSE(through(bar, across(0.05, 0.3), across(0.02, 0.3)));                      // not so far
        CHECK_FALSE(through(bar, across(0.05, 1.3), across(-0.05, 1.3)));                     // past its end
        CHECK_FALSE(
            through(bar, link({0.1, 0, 0.05}, {0.03, 0, 0.05}), link({0.1, 0, -0.05}, {0.03, 0, -0.05})));
        CHECK_FALSE(
            through(bar, link({0, 0.3, 0.05}, {0, 0.2, 0.05}), link({0, 0.3, -0.05}, {0, 0.2, -0.05})));
    }
}

TEST_CASE("a link goes through a ball or a cube near the centre, through a plate away from the rim")
{
    const auto at = [](double y, double aside) { return link({-1, y, aside}, {1, y, aside}); };
    for (const SolidShape& shape : {solid_shape(ball(0.1)), solid_shape(box({0.1, 0.1, 0.1}))})
    {
        CHECK(link_goes_through(shape, 2, at(0.5, 0.04), at(-0.5, 0.04)));
        CHECK_FALSE(link_goes_through(shape, 2, at(0.5, 0.06), at(-0.5, 0.06)));
        CHECK_FALSE(link_goes_through(shape, 2, at(0.5, 0), at(0.01, 0)));
    }
    const SolidShape plate = solid_shape(box({1, 0.01, 1}));
    const auto lies = [](double y, double x) { return link({x, y, 0.4}, {x + 0.1, y, 0.4}); };
    CHECK(link_goes_through(plate, 0.1, lies(0.1, 0.3), lies(-0.1, 0.3)));
    CHECK_FALSE(link_goes_through(plate, 0.1, lies(0.1, 0.9), lies(-0.1, 0.9)));
    CHECK_FALSE(link_goes_through(plate, 0.1, lies(0.1, 0.3), lies(0.02, 0.3)));
    const TriangleCorners stands = link({1.2, 0.1, 0.4}, {1.2, -0.1, 0.4});
    TriangleCorners cut = stands;
    for (glm::dvec3& p : cut)
        p.x -= 1.4; // as a blade would
    CHECK(link_goes_through(plate, 0.1, stands, cut));
}

TEST_CASE("a watch sees a rope on the other side of a bar that it fell on")
{
    Watched run(flat(1, 2), capsule(0.02, 1));
    run.scene.bodies[0].mesh.triangles.clear();
    run.scene.bodies[0].mesh.links = {{0, 1}, {1, 2}};
    run.watch = CrossingWatch(run.scene);
    const auto rope = [](double z) {
        return TriangleCorners{glm::dvec3(-0.15, 0, z), glm::dvec3(-0.05, 0, z), glm::dvec3(0.05, 0, z)};
    };
    run.look(0, rope(0.1));
    CHECK(run.look(1.0 / 60, rope(0.03)).seen.empty());
    CHECK(run.look(2.0 / 60, rope(-0.03)).seen.size() == 1);
}

TEST_CASE("a hole is as wide as the smallest ball round the corners")
{
    CHECK(hole_of(flat(0, 2)) == Approx(2));
    CHECK(hole_of({glm::dvec3(0), glm::dvec3(3, 0, 0), glm::dvec3(0, 4, 0)}) == Approx(2.5)); // right
    CHECK(hole_of({glm::dvec3(0), glm::dvec3(4, 0, 0), glm::dvec3(2, 0.1, 0)}) == Approx(2)); // flat
    CHECK(hole_of(link({0, 0, 0}, {0, 6, 0})) == Approx(3));
}

TEST_CASE("a collider is as wide as it looks along its way")
{
    CHECK(width_across(solid_shape(ball(0.3)), {0, 1, 0}) == Approx(0.3));
    CHECK(width_across(solid_shape(capsule(0.1, 1)), {0, 1, 0}) == Approx(0.1));
    CHECK(width_across(solid_shape(capsule(0.1, 1)), {1, 0, 0}) == Approx(1.1));
    CHECK(width_across(solid_shape(capsule(0.1, 1)), glm::dvec3(0)) == Approx(1.1));
    CHECK(width_across(solid_shape(box({1, 0.1, 0.2})), {1, 0, 0}) == Approx(0.2));
    CHECK(width_across(solid_shape(box({1, 0.1, 0.2})), {0, 0.6, 0.8}) == Approx(1));
}

TEST_CASE("the middle of a collider is its centre, its axis, its plane")
{
    CHECK(middle_points(solid_shape(ball(1)), 0.1).size() == 1);
    const auto axis = middle_points(solid_shape(capsule(0.1, 0.35)), 0.1);
    CHECK(axis.size() == 9); // 0.0875 apart
    CHECK(glm::length(axis.back() - axis.front()) == Approx(0.7));
    CHECK(middle_points(solid_shape(box({0.2, 0.2, 0.2})), 0.1).size() == 1);
    for (const glm::dvec3& p : middle_points(solid_shape(box({1, 0.01, 1})), 0.1))
    {
        CHECK(p.y == 0);
        CHECK(std::max(std::abs(p.x), std::abs(p.z)) <= 0.85 + 1e-12); // not at the rim
    }
}

TEST_CASE("a watch sees a ball on the other side though no look saw it between")
{
    Watched run(flat(1, 2), ball(0.5));
    run.look(0, flat(1, 2));
    CHECK(run.look(0.1, flat(0.8, 2)).seen.empty());
    const Crossings& found = run.look(0.2, flat(-0.8, 2));
    REQUIRE(found.seen.size() == 1);
    CHECK(found.passed == 1);
    CHECK(found.elements == 0); // at the looks it was clear of the ball
    CHECK(found.seen[0].body == "cloth");
    CHECK(found.seen[0].collider == "thing");
    CHECK(found.seen[0].frame == 2);
    CHECK(found.seen[0].time == 0.2);
    CHECK(found.seen[0].through);
}

TEST_CASE("a watch sees a moving collider go through cloth at rest")
{
    for (const bool turned : {false, true})
    {
        Collider plate = box({0.5, 0.02, 0.5});
        plate.point = {0, 1, 0};
        if (turned)
            plate.rotate_axis = {1, 0, 0}, plate.rotate_degrees = 90; // edge on
        plate.motion = {{0, {}}, {1, {0, -2, 0}}};
        Watched run(flat(0, 2), plate);
        run.look(0, flat(0, 2));
        CHECK(run.look(0.2, flat(0, 2)).seen.empty());
        CHECK(run.look(0.9, flat(0, 2)).seen.size() == 1);
    }
}

TEST_CASE("a watch tells an element deep in a collider, and how deep")
{
    Watched run(flat(1, 2), ball(0.5));
    run.look(0, flat(1, 2));
    CHECK(run.look(0.1, flat(0.3, 2)).elements == 0); // 0.2 of 0.5
    const Crossings& found = run.look(0.2, flat(0.1, 2));
    CHECK(found.elements == 1);
    CHECK(found.depth == Approx(0.4));
    CHECK(found.passed == 0);
    REQUIRE(found.seen.size() == 1);
    CHECK_FALSE(found.seen[0].through);
    run.look(0.3, flat(0.05, 2));
    CHECK(found.seen.size() == 1); // once for a body and a collider
    CHECK(found.seen[0].frame == 2);
}

TEST_CASE("what starts within a collider is not said to have come through it, until it has been out")
{
    Watched run(flat(0.1, 2), ball(0.5));
    run.look(0, flat(0.1, 2));
    run.look(0.1, flat(0.05, 2));
    CHECK(run.look(0.2, flat(0.6, 2)).seen.empty()); // outwards
    run.look(0.25, flat(0.7, 2));
    CHECK(run.look(0.3, flat(-0.7, 2)).seen.size() == 1);
}

TEST_CASE("may_tunnel: wide holes or long ways, and only near the collider")
{
    std::string meets = "vertices";
    const auto likely = [&](double around, double radius, double height, double speed) {
        Collider collider = ball(radius);
        collider.meets = option_named<ColliderMeets>(meets);
        Watched run(flat(height, around), collider);
        return run.look(0, flat(height, around), {0, -speed, 0}).likely.size();
    };
    CHECK(likely(0.5, 0.4, 0.401, 0) == 0);   // at rest, apart
    CHECK(likely(0.5, 0.4, 0.401, 0.5) == 1); // a hole of 0.5 takes a ball of 0.4
    CHECK(likely(0.5, 0.6, 0.601, 0.5) == 0);
    CHECK(likely(0.5, 0.6, 3, 0.5) == 0);
    CHECK(likely(0.5, 0.6, 3, 170) == 0); // 0.28 a substep
    CHECK(likely(0.5, 0.6, 3, 200) == 1); // 0.33 a substep is more than half of 0.6
    CHECK(likely(0.5, 0.6, 9, 200) == 0); // not within this frame
    meets = "surface";
    CHECK(likely(0.5, 0.4, 0.401, 0.5) == 0); // no hole lets it through
    CHECK(likely(0.5, 0.6, 3, 200) == 1);     // but speed may
}

TEST_CASE("each element's own distance and speed tell when to look again")
{
    const std::size_t slow = GENERATE(0u, 1u); // which of two triangles is near and slow
    Watched run(flat(3, 1), ball(0.5));
    Mesh& mesh = run.scene.bodies[0].mesh;
    std::vector<glm::dvec3> v(6, glm::dvec3(0));
    const std::vector<glm::dvec3> corners{{1, 0, 0}, {-0.5, 0, 0.8}, {-0.5, 0, -0.8}};
    mesh.positions.clear();
    for (std::size_t k = 0; k < 6; ++k)
        mesh.positions.push_back(corners[k % 3] + glm::dvec3(0, k / 3 == slow ? 0.6 : 2, 0));
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    run.scene.gravity = glm::dvec3(0);
    const auto clear_for = [&](double near, double far) {
        for (std::size_t k = 0; k < 6; ++k)
            v[k] = {0, -(k / 3 == slow ? near : far), 0};
        CrossingWatch watch(run.scene);
        watch.look(0, 0, 1e-3, mesh.positions, v);
        return watch.clear_for();
    };
    CHECK(clear_for(6, 12) == Approx(0.6 / 12));    // the near one, at its own speed
    CHECK(clear_for(1, 12) == Approx(2.0 / 24));    // the far one: the near one could only be drawn along
    CHECK(clear_for(0, 80) == Approx(2.0 / 160));
    CHECK(clear_for(4, 8) == Approx(0.6 / 8));
}

TEST_CASE("a watch says until when nothing can have reached the middle")
{
    Watched run(flat(3, 1), ball(0.5));
    run.scene.gravity = glm::dvec3(0);
    CrossingWatch watch(run.scene);
    const std::vector<glm::dvec3> at{{1, 3, 0}, {-0.5, 3, 0.8}, {-0.5, 3, -0.8}};
    const std::vector<glm::dvec3> slow(3, {0, -1, 0}), still(3, glm::dvec3(0));
    watch.look(0, 0, 1e-3, at, slow);
    CHECK(watch.clear_for() == Approx(3.0 / 2));
    watch.look(1, 0.1, 1e-3, at, still);
    CHECK(watch.clear_for() == std::numeric_limits<double>::infinity());
    run.scene.gravity = {0, -10, 0};
    CrossingWatch falling(run.scene);
    falling.look(0, 0, 1e-3, at, still);
    CHECK(falling.clear_for() == Approx(std::sqrt(0.3 / 0.75)));
    run.scene.colliders[0].motion = {{4, {}}, {5, {0, 100, 0}}}; // not yet
    run.scene.gravity = glm::dvec3(0);
    CrossingWatch led(run.scene);
    led.look(0, 0, 1e-3, at, still);
    CHECK(led.clear_for() == Approx(3.0 / 200));
    Scene empty = run.scene;
    empty.colliders[0].kind = ColliderKind::plane;
    CrossingWatch idle(empty);
    idle.look(0, 0, 1e-3, at, slow);
    CHECK_FALSE(idle.needed());
    CHECK(idle.clear_for() == std::numeric_limits<double>::infinity());
}

TEST_CASE("a watch leaves bodies alone whose positions are not finite, and starts again after a tear")
{
    Watched run(flat(1, 2), ball(0.5));
    run.look(0, flat(1, 2));
    TriangleCorners lost = flat(-1, 2);
    lost[1].x = std::numeric_limits<double>::quiet_NaN();
    CHECK(run.look(0.1, lost).seen.empty());
    CHECK(run.look(0.2, flat(-1, 2)).seen.empty()); // of what came before it knows nothing
    run.watch.set_scene(run.scene);
    CHECK(run.look(0.3, flat(1, 2)).seen.empty());
    CHECK(run.look(0.4, flat(-1, 2)).seen.size() == 1);
}

} // namespace
