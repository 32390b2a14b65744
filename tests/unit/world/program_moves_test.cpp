// What a program moves while it runs: the same motion by keyframes, bit for bit, and what it refuses.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/program_moves.hpp"
#include "support/scenes.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <limits>

using namespace taut;
using test::kMovedSteps;
using test::moved_scene;

namespace {

void check_same(const WorldState& a, const WorldState& b)
{
    CHECK((a.step == b.step));
    CHECK((a.position == b.position));
    CHECK((a.low == b.low));
    CHECK((a.velocity == b.velocity));
    CHECK((a.delta == b.delta));
    CHECK((a.kept == b.kept));
}

/// By the program, each order `late` steps after it is due.
WorldState run_by_program(const Scene& scene, const std::string& selector, std::size_t steps,
                          std::size_t late = 0)
{
    World world(scene, test_device(selector));
    for (std::size_t k = 1; k <= steps; ++k)
    {
        if (k > late)
            test::order(world, k - late);
        world.step();
    }
    return world.state();
}

WorldState run_by_keys(const Scene& scene, const std::string& selector, std::size_t steps)
{
    World world(scene, test_device(selector));
    for (std::size_t k = 0; k < steps; ++k)
        world.step();
    return world.state();
}

} // namespace

TEST_CASE("what the program moves is bit-equal to the same motion by keyframes, on every executor")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const WorldState keys = run_by_keys(moved_scene(true), selector, kMovedSteps);
    check_same(run_by_program(moved_scene(false), selector, kMovedSteps), keys);
}

TEST_CASE("the program moves things under every method and in double as keyframes do")
{
    const auto method = GENERATE(from_range(kWords<MethodKind>));
    const std::string precision = GENERATE("float", "double");
    CAPTURE(method, precision);
    const WorldState keys =
        run_by_keys(moved_scene(true, std::string(method), precision), "cpu:serial", kMovedSteps);
    check_same(run_by_program(moved_scene(false, std::string(method), precision), "cpu:serial", kMovedSteps),
               keys);
}

TEST_CASE("orders that are not followed, or a step late, move the cloth elsewhere")
{
    const WorldState keys = run_by_keys(moved_scene(true), "cpu:serial", 6);
    CHECK((run_by_keys(moved_scene(false), "cpu:serial", 6).position != keys.position));
    CHECK((run_by_program(moved_scene(false), "cpu:serial", 6, 1).position != keys.position));
}

TEST_CASE("what was moved stands still until the next order, and drags nothing then")
{
    Scene by_keys = moved_scene(true), by_program = moved_scene(false);
    for (Collider& c : by_keys.colliders)
        c.motion.resize(6);
    for (Pin& pin : by_keys.bodies[0].pins)
        pin.motion.resize(6);
    by_keys.wind.keys.resize(6);
    World world(by_program, test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 12; ++k)
    {
        if (k <= 5)
            test::order(world, k);
        world.step();
    }
    check_same(world.state(), run_by_keys(by_keys, "cpu:serial", 12));
    CHECK(world.collider_pose(test::kBall).translate == test::path(test::kBall, 5).translate);
}

TEST_CASE("of two orders before a step the later holds")
{
    World once(moved_scene(false), test_device("cpu:serial")),
        twice(moved_scene(false), test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 4; ++k)
    {
        test::order(once, k);
        test::order(twice, k + 2);
        test::order(twice, k);
        once.step();
        twice.step();
    }
    check_same(twice.state(), once.state());
}

TEST_CASE("a collider goes on with its velocity until it is told otherwise")
{
    Scene keyed = moved_scene(false);
    keyed.timestep = 1.0 / 64; // sums without rounding
    Scene free = keyed;
    keyed.colliders[test::kBall].motion = {{0, {}}, {0.125, {0.25, 0.5, 0}}, {1, {0.25, 0.5, 0}}};
    keyed.colliders[test::kCuboid].motion = {{0, {}}};
    World by_keys(keyed, test_device("cpu:serial")), world(free, test_device("cpu:serial"));
    world.set_collider_velocity(test::kBall, {2, 4, 0});
    for (int k = 0; k < 16; ++k)
    {
        if (k == 8)
            world.set_collider_velocity(test::kBall, {0, 0, 0});
        world.step();
        by_keys.step();
    }
    check_same(world.state(), by_keys.state());
}

TEST_CASE("a collider that goes on turning turns about its middle")
{
    World world(moved_scene(false), test_device("cpu:serial"));
    const double h = world.scene().timestep;
    const glm::dvec3 middle(-0.4, -0.12, 0.1), corner(-0.2, -0.02, 0.25);
    world.set_collider_velocity(test::kCuboid, {0, 0, 0}, {0, 2, 0});
    for (int k = 0; k < 5; ++k)
        world.step();
    world.set_collider_velocity(test::kCuboid, {1, 0, 0}, {3, 0, 0});
    for (int k = 0; k < 5; ++k)
        world.step();
    const std::vector<Keyframe>& motion = world.scene().colliders[test::kCuboid].motion;
    const glm::dvec3 moved = pose(motion, world.time(), middle);
    CHECK(glm::distance(moved, middle + glm::dvec3(5 * h, 0, 0)) < 1e-12);
    // First about y, then about x.
    const glm::dvec3 arm = corner - middle;
    const double a = 10 * h, b = 15 * h;
    const glm::dvec3 one(arm.x * std::cos(a) + arm.z * std::sin(a), arm.y,
                         -arm.x * std::sin(a) + arm.z * std::cos(a));
    const glm::dvec3 two(one.x, one.y * std::cos(b) - one.z * std::sin(b),
                         one.y * std::sin(b) + one.z * std::cos(b));
    CHECK(glm::distance(pose(motion, world.time(), corner) - moved, two) < 1e-12);
}

TEST_CASE("turns whose angle starts anew are taken the short way")
{
    World world(moved_scene(false), test_device("cpu:serial"));
    const auto turned = [](double degrees) {
        return Keyframe{
            .rotate_axis = {0, 1, 0}, .rotate_degrees = degrees, .rotate_centre = {-0.4, -0.12, 0.1}};
    };
    for (int k = 1; k <= 4; ++k)
    {
        world.set_collider_pose(test::kCuboid, turned(89 * k));
        world.step();
    }
    world.set_collider_pose(test::kCuboid, turned(4)); // from 356
    world.step();
    const std::vector<Keyframe>& motion = world.scene().colliders[test::kCuboid].motion;
    const double half = world.time() - 0.5 * world.scene().timestep;
    const glm::dvec3 x(-0.2, -0.12, 0.1);
    CHECK(glm::distance(pose(motion, half, x), x) < 1e-9); // 0 on the way
}

TEST_CASE("a restored state has the poses, and the orders that wait")
{
    World world(moved_scene(false), test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 5; ++k)
    {
        test::order(world, k);
        world.step();
    }
    test::order(world, 6);
    world.set_collider_velocity(test::kFloor, {0.1, 0, 0});
    const WorldState kept = world.state();
    const auto finish = [](World& w) {
        for (int k = 0; k < 4; ++k)
            w.step();
        return w.state();
    };
    const WorldState first = finish(world);
    World other(moved_scene(false), test_device("cpu:serial"));
    other.set_collider_pose(test::kCapsule, test::path(test::kCapsule, 3));
    other.step();
    other.restore(kept);
    check_same(finish(other), first);
    world.restore(kept);
    check_same(finish(world), first);
    World fresh(moved_scene(false), test_device("cpu:serial"));
    world.restore(fresh.state()); // everything is back at rest
    check_same(run_by_keys(moved_scene(false), "cpu:serial", 4), finish(world));
}

TEST_CASE("a world of the scene that another one had has its colliders where they were")
{
    World world(moved_scene(false), test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 3; ++k)
    {
        world.set_collider_pose(test::kBall, test::path(test::kBall, k));
        world.step();
    }
    World again(world.scene(), test_device("cpu:serial"));
    const glm::dvec3 there = test::path(test::kBall, 3).translate;
    CHECK(again.collider_pose(test::kBall).translate == there);
    World moved = std::move(again); // and its orders go along
    moved.set_collider_pose(test::kBall, {.translate = there});
    moved.step();
    CHECK(pose(moved.scene().colliders[test::kBall].motion, 0, glm::dvec3(0)) == there);
}

TEST_CASE("pins of cloth that tears are led on as by keyframes, in the order of before")
{
    const auto scene_of = [](bool by_keys) {
        Scene scene = test::hanging(10);
        Body& body = scene.bodies[0];
        body.material.tear_strain = 0.1;
        Pin left = body.pins[0], right = body.pins[0];
        left.vertices = {0, 11, 22, 33, 44, 55, 66, 77, 88, 99, 110}; // the sides
        right.vertices = {10, 21, 32, 43, 54, 65, 76, 87, 98, 109, 120};
        body.pins = {left, right};
        for (std::size_t k = 0; k <= 30 && by_keys; ++k)
        {
            const double time = static_cast<double>(k) * scene.timestep;
            body.pins[0].motion.push_back({time, {-0.012 * double(k), 0, 0}});
            body.pins[1].motion.push_back({time, {0.012 * double(k), 0, 0}});
        }
        for (Pin& pin : body.pins)
            pin.moved_by_program = !by_keys;
        return scene;
    };
    World keys(scene_of(true), test_device("cpu:serial")),
        program(scene_of(false), test_device("cpu:serial"));
    for (std::size_t k = 1; k <= 30; ++k)
    {
        program.set_pin_pose(0, 0, {.translate = {-0.012 * double(k), 0, 0}});
        program.set_pin_pose(0, 1, {.translate = {0.012 * double(k), 0, 0}});
        program.step();
        keys.step();
    }
    CHECK(program.torn() > 0);
    CHECK(program.torn() == keys.torn());
    check_same(program.state(), keys.state());
    std::size_t held = 0;
    for (const Pin& pin : program.scene().bodies[0].pins)
        held += pin.vertices.size();
    CHECK(program.pin_targets().size() == held);
}

TEST_CASE("wrong orders are refused by the name of the argument, and change nothing")
{
    Scene scene = moved_scene(false);
    scene.colliders.push_back(scene.colliders[test::kBall]);
    scene.colliders.back().motion = {{0, {}}, {1, {0, 1, 0}}};
    World world(scene, test_device("cpu:serial")), untouched(scene, test_device("cpu:serial"));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto fails = [](auto&& order, const std::string& what) {
        CHECK_THROWS_WITH(order(), Contains(what));
        try
        {
            order();
        }
        catch (const Error& error)
        {
            CHECK(error.code() == ErrorCode::bad_input);
        }
    };
    fails([&] { world.set_collider_pose(5, {}); }, "set_collider_pose: collider 5 of 5");
    fails([&] { world.set_collider_pose(4, {}); }, "collider 4 moves by the keyframes of the scene");
    fails([&] { world.set_collider_pose(0, {.translate = {nan, 0, 0}}); }, "translate of collider 0");
    fails(
        [&] {
            world.set_collider_pose(0, {.rotate_axis = {0, 0, 0}, .rotate_degrees = 3});
        },
        "rotate_axis");
    fails([&] { world.set_collider_pose(0, {.rotate_degrees = nan}); }, "rotate_degrees of collider 0");
    fails([&] { world.set_collider_pose(0, {.translate = {0, 20, 0}}); }, "1.2e+03 m/s in the next step");
    fails([&] { world.set_collider_pose(test::kFloor, {.rotate_degrees = 1}); }, "collider 1, a plane");
    const std::size_t two[] = {0, 0};
    const Keyframe poses[] = {{.translate = {0, 1, 0}}, {.translate = {0, 1, 0}}};
    fails([&] { world.set_collider_poses(two, poses); }, "collider 0 is there twice");
    fails([&] { world.set_collider_poses(two, std::span(poses).first(1)); }, "1 poses for 2 colliders");
    const std::size_t last_is_wrong[] = {0, 17};
    fails([&] { world.set_collider_poses(last_is_wrong, poses); }, "collider 17 of 5");
    fails([&] { world.set_collider_velocity(0, {nan, 0, 0}); }, "the velocity of collider 0");
    fails([&] { world.set_collider_velocity(0, {0, 0, 0}, {0, 0, nan}); }, "the turn of collider 0");
    fails([&] { world.set_collider_velocity(0, {0, 0, 0}, {0, 0, 400}); }, "382 degrees in the next step");
    fails([&] { world.set_collider_velocity(0, {2000, 0, 0}); }, "2e+03 m/s");
    const std::vector<glm::dvec3> targets = world.pin_targets();
    REQUIRE(targets.size() == 10);
    std::vector<glm::dvec3> wrong = targets;
    wrong[0] += glm::dvec3(0.1);
    wrong[3].y = nan;
    fails([&] { world.set_pin_targets(wrong); }, "target 2 of pin 1 of body 0 is not finite");
    wrong[3].y = 40;
    fails([&] { world.set_pin_targets(wrong); }, "target 2 of pin 1 of body 0 would move at");
    fails([&] { world.set_pin_targets(std::span(targets).first(9)); }, "9 targets for 10 vertices");
    fails([&] { world.set_pin_targets(0, 1, targets); }, "10 targets for 9 vertices of pin 1");
    fails([&] { world.set_pin_targets(1, 0, targets); }, "body 1 of 1");
    fails([&] { world.set_pin_targets(0, 2, targets); }, "pin 2 of 2 of body 0");
    fails([&] { world.set_pin_pose(0, 0, {.translate = {0, nan, 0}}); }, "translate of pin 0");
    fails([&] { world.set_wind({nan, 0, 0}); }, "set_wind: the velocity is not finite");
    fails([&] { world.set_wind({0, 1e4, 0}); }, "the wind would move at 1e+04 m/s");
    for (World* w : {&world, &untouched})
        for (int k = 0; k < 3; ++k)
            w->step();
    check_same(world.state(), untouched.state());
}

TEST_CASE("what a scene has not said can be moved is refused in words")
{
    World held(test::hanging(), test_device("cpu:serial"));
    const glm::dvec3 targets[] = {{}, {}};
    CHECK_THROWS_WITH(held.set_pin_targets(0, 0, targets), Contains("set its moved_by_program to true"));
    CHECK_THROWS_WITH(held.set_wind({1, 0, 0}), Contains("wind.density"));
    CHECK(held.pin_targets().empty());
    World keyed(moved_scene(true), test_device("cpu:serial"));
    CHECK_THROWS_WITH(keyed.set_wind({1, 0, 0}), Contains("keys of the scene"));
    Scene both = moved_scene(true);
    both.bodies[0].pins[0].moved_by_program = true;
    CHECK_THROWS_WITH(resolve(both), Contains("moved_by_program"));
}
