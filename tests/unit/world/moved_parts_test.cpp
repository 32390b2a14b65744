// What the program moves in worlds that are made of others: bodies that sleep, bodies and vertices divided
// between devices.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/program_moves.hpp"

#include "taut/world/hybrid.hpp"
#include "taut/world/sleep.hpp"
#include "taut/world/split.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace taut;

namespace {

/// Soft blocks on a floor, 2 m apart; each has a pin that the program may move, but the last. The ball is 1 m
/// above the first.
Scene blocks()
{
    Scene scene;
    for (int k = 0; k < 3; ++k)
    {
        Body body;
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = {2, 2, 2};
        body.material = solid_material();
        body.transform.translate = {2.0 * k, 0.502, 0};
        Pin pin;
        pin.faces = {"bottom"};
        pin.moved_by_program = true;
        if (k < 2)
            body.pins = {pin};
        scene.bodies.push_back(body);
    }
    Collider floor, ball;
    floor.kind = ColliderKind::plane;
    floor.friction = 0.5;
    ball.point = {0, 2.5, 0};
    scene.colliders = {floor, ball};
    scene.damping = 3;
    return resolve(scene);
}

void sleep_all(SleepWorld& world)
{
    for (int k = 0; k < 600 && world.asleep() < 3; ++k)
        world.step();
    REQUIRE(world.asleep() == 3);
}

Scene two_cloths(bool wind)
{
    Scene scene = test::moved_scene(false);
    scene.bodies.push_back(scene.bodies[0]);
    for (Body& body : scene.bodies)
        body.material.drag = wind ? body.material.drag : 0;
    return scene;
}

template <typename Worlds>
void order_both(Worlds& world, std::size_t step, bool wind)
{
    test::order(world, step, wind);
    world.set_pin_pose(1, 1, test::path(4, step));
}

} // namespace

TEST_CASE("a sleeping body wakes where the program moves its pin, in that step")
{
    SleepWorld world(blocks(), test_device("cpu:serial"));
    sleep_all(world);
    world.set_pin_pose(1, 0, {.translate = {0.01, 0, 0}});
    world.step();
    CHECK(!world.asleep(1));
    CHECK(world.asleep(0));
    CHECK(world.asleep(2));
    const std::uint32_t held = world.scene().bodies[1].pins[0].vertices[0];
    const auto at = static_cast<std::size_t>(held) + 27;
    CHECK(world.positions()[at].x == Approx(world.scene().bodies[1].mesh.positions[held].x + 0.01));
}

TEST_CASE("a sleeping body wakes before a collider that the program moves reaches it")
{
    SleepWorld world(blocks(), test_device("cpu:serial"));
    sleep_all(world);
    const std::vector<glm::dvec3> before = world.positions();
    world.set_collider_velocity(1, {0, -1, 0});
    while (world.asleep(0) && world.collider_pose(1).translate.y > -1.5)
        world.step();
    CHECK(!world.asleep(0));
    CHECK(world.collider_pose(1).translate.y > -1.0); // the gap was 1 m
    CHECK(world.asleep(2));
    for (int k = 0; k < 30; ++k)
        world.step();
    double pushed = 0;
    for (std::size_t v = 0; v < 27; ++v)
        pushed = std::max(pushed, glm::distance(world.positions()[v], before[v]));
    CHECK(pushed > 0.05);
    // A collider that has stopped lets it sleep again, and stays where it is.
    world.set_collider_velocity(1, {0, 0, 0});
    sleep_all(world);
    World whole(blocks(), test_device("cpu:serial"));
    world.copy_into(whole);
    CHECK(whole.collider_pose(1).translate.y == world.collider_pose(1).translate.y);
}

TEST_CASE("places and velocities that are set wake a body")
{
    SleepWorld world(blocks(), test_device("cpu:serial"));
    sleep_all(world);
    const std::vector<glm::dvec3> x = world.positions();
    world.set_positions(2, std::vector(x.begin() + 54, x.end()));
    CHECK(!world.asleep(2));
    world.set_velocities(0, std::vector(27, glm::dvec3(0, 0, 0.1)));
    CHECK(!world.asleep(0));
    CHECK(world.asleep(1));
    CHECK_THROWS_WITH(world.set_positions(3, x), Contains("body 3 of 3"));
}

TEST_CASE("a hybrid world moves what the program moves as one world does, also after new divisions")
{
    HybridOptions options;
    options.measure_every = 4;
    HybridWorld hybrid(two_cloths(true), test_device("cpu:serial"), test_device("cpu"), options);
    World whole(two_cloths(true), test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 16; ++k)
    {
        order_both(hybrid, k, true);
        order_both(whole, k, true);
        if (k == 6)
        {
            const std::vector<glm::dvec3> x = whole.positions(1), v(x.size(), glm::dvec3(0, 1, 0));
            whole.set_positions(1, x);
            hybrid.set_positions(1, x);
            whole.set_velocities(1, v);
            hybrid.set_velocities(1, v);
        }
        hybrid.step();
        whole.step();
    }
    CHECK((hybrid.positions() == whole.positions()));
    World copy(two_cloths(true), test_device("cpu:serial"));
    hybrid.copy_into(copy);
    CHECK(copy.pin_targets() == whole.pin_targets());
}

TEST_CASE("a split world moves what the program moves as one world does")
{
    SplitOptions options;
    options.share = 0.4;
    Scene scene = two_cloths(false);
    for (Collider& c : scene.colliders)
        c.meets = ColliderMeets::vertices;
    SplitWorld split(scene, test_device("cpu:serial"), test_device("cpu:serial"), options);
    World whole(scene, test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 12; ++k)
    {
        order_both(split, k, false);
        order_both(whole, k, false);
        split.step();
        whole.step();
    }
    CHECK((split.positions() == whole.positions()));
}
