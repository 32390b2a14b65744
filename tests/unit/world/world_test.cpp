#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <cmath>
#include <cstring>
#include <limits>

using namespace taut;

namespace {

WorldState run(const Scene& scene, const std::string& device, int steps, const WorldOptions& options = {})
{
    World world(scene, test_device(device), options);
    for (int i = 0; i < steps; ++i)
        world.step();
    return world.state();
}

bool same(const WorldState& a, const WorldState& b)
{
    return a.step == b.step && a.position == b.position && a.low == b.low && a.velocity == b.velocity;
}

} // namespace

TEST_CASE("a world without a device is refused")
{
    CHECK_THROWS_WITH(World(test::everything(), nullptr),
                      "a World was given no device; give one that Device::open returned");
}

TEST_CASE("a step is one submission, whatever the number of passes")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World world(test::everything(), test_device(device));
        world.step();
        const DeviceCounters before = world.device().counters();
        world.step();
        world.step();
        world.device().wait();
        const DeviceCounters after = world.device().counters();
        CHECK(after.submissions - before.submissions == 2);
        CHECK(after.dispatches - before.dispatches == 2 * world.plan().passes.size());
        CHECK(after.barriers - before.barriers == 2 * world.plan().barrier_count());
        CHECK(after.validation_messages == 0);
    }
}

TEST_CASE("runs repeat bitwise on one device (G06)")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        CHECK(same(run(test::everything(), device, 20), run(test::everything(), device, 20)));
    }
}

TEST_CASE("the native executors agree bitwise: no pass depends on an order that is not promised")
{
    const WorldState serial = run(test::everything(16), "cpu:serial", 30);
    CHECK(same(serial, run(test::everything(16), "cpu", 30)));
    CHECK(same(serial, run(test::everything(16), "cpu:shuffled", 30)));
}

TEST_CASE("grouped small colours and bodies move bitwise as with a dispatch a colour")
{
    Scene scene = test::everything(6);
    scene.bodies.resize(3, scene.bodies[0]);
    WorldOptions never, always;
    never.plan.small_bodies = PlanOptions::SmallBodies::never;
    always.plan.small_bodies = PlanOptions::SmallBodies::always;
    for (const std::string& device : test_devices())
    {
        INFO(device);
        CHECK(same(run(scene, device, 10, never), run(scene, device, 10, always)));
    }
}

TEST_CASE("keeping residuals changes no position")
{
    WorldOptions keep;
    keep.plan.residuals = true;
    Scene scene = test::everything();
    scene.method.iterations = 1;
    for (const std::string& device : test_devices())
    {
        INFO(device);
        CHECK(same(run(scene, device, 10), run(scene, device, 10, keep)));
    }
}

TEST_CASE("an effect that exists but is not used changes no bit (G08)")
{
    WorldOptions only;
    only.plan.available_effects = {"motion", "distance"};
    for (const std::string& device : test_devices())
    {
        INFO(device);
        CHECK(same(run(test::hanging(), device, 20), run(test::hanging(), device, 20, only)));
    }
}

TEST_CASE("copies of a body stay bitwise copies (G07)")
{
    Scene scene = test::hanging(7);
    scene.bodies.resize(5, scene.bodies[0]);
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World world(scene, test_device(device));
        for (int i = 0; i < 20; ++i)
            world.step();
        const auto x = world.positions();
        const std::size_t n = x.size() / 5;
        for (std::size_t k = n; k < x.size(); ++k)
            REQUIRE(x[k] == x[k % n]);
    }
}

TEST_CASE("a restored state continues bitwise (G09)")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World straight(test::everything(), test_device(device)),
            first(test::everything(), test_device(device));
        for (int i = 0; i < 12; ++i)
            straight.step();
        for (int i = 0; i < 5; ++i)
            first.step();
        const WorldState saved = first.state();
        World second(test::everything(), test_device(device));
        second.restore(saved);
        for (int i = 0; i < 7; ++i)
            second.step();
        CHECK(same(straight.state(), second.state()));
    }
}

TEST_CASE("a state that does not fit or is not finite is refused and changes nothing")
{
    World world(test::hanging(), test_device("cpu:serial"));
    world.step();
    const WorldState before = world.state();
    WorldState wrong = before;
    wrong.position.pop_back();
    CHECK_THROWS_AS(world.restore(wrong), Error);
    wrong = before;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(wrong.velocity.data() + 16, &nan, sizeof nan);
    CHECK_THROWS_AS(world.restore(wrong), Error);
    CHECK(same(world.state(), before));
}

TEST_CASE("a force that is not finite is refused and the state stays (G05)")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World world(test::everything(), test_device(device));
        for (int i = 0; i < 3; ++i)
            world.step();
        const WorldState before = world.state();
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
            try
            {
                world.set_force(3, {0, bad, 0});
                FAIL("accepted");
            }
            catch (const Error& error)
            {
                CHECK(error.code() == ErrorCode::bad_input);
            }
        CHECK(same(world.state(), before));
        CHECK(world.state().force == before.force);
        World plain(test::hanging(), test_device(device));
        CHECK_THROWS_AS(plain.set_force(0, {0, 1, 0}), Error);
        CHECK_THROWS_AS(world.set_force(100000, {0, 1, 0}), Error);
    }
}

TEST_CASE("a force moves its vertex as Newton says")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 0;
    body.vertex_masses = {0.5};
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    scene.external_forces = true;
    scene.timestep = 0.01;
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World world(scene, test_device(device));
        world.set_force(0, {1, 0, 0});
        for (int i = 0; i < 100; ++i)
            world.step();
        CHECK(world.velocities()[0].x == Approx(2.0).epsilon(1e-5));
    }
}

TEST_CASE("forces on all vertices at once are those set one by one, and go with the state")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World one(test::everything(), test_device(device)), all(test::everything(), test_device(device));
        std::vector<glm::dvec3> forces(one.positions().size());
        for (std::size_t v = 0; v < forces.size(); ++v)
            forces[v] = {0.01 * std::sin(double(v)), 0.02, 0.01 * std::cos(double(v))};
        const glm::dvec3 without = one.positions()[5];
        for (int i = 0; i < 3; ++i)
        {
            one.step();
            all.step();
            for (std::uint32_t v = 0; v < forces.size(); ++v)
                one.set_force(v, (i + 1.0) * forces[v]);
            for (glm::dvec3& force : forces)
                force *= i + 1.0;
            all.set_forces(forces);
            for (glm::dvec3& force : forces)
                force /= i + 1.0;
        }
        CHECK(all.state().force == one.state().force); // although no step has used the last ones
        World third(test::everything(), test_device(device));
        third.restore(all.state());
        for (World* world : {&one, &all, &third})
            world->step();
        CHECK(same(one.state(), all.state()));
        CHECK(same(third.state(), all.state()));
        CHECK(all.positions()[5] != without);
        CHECK(all.drive().push > 0);
        CHECK_THROWS_WITH(all.set_forces(std::vector<glm::dvec3>(3)), Contains("3 forces for a world of"));
        forces.back().y = std::nan("");
        CHECK_THROWS_WITH(all.set_forces(forces), Contains("is not finite"));
        CHECK(all.state().force == one.state().force);
    }
}

TEST_CASE("a timed step moves the world as a plain one and times every effect")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World plain(test::everything(), test_device(device)), timed(test::everything(), test_device(device));
        plain.step();
        plain.step();
        timed.step();
        std::uint64_t dispatches = 0;
        for (const EffectTime& effect : timed.step_timed())
        {
            dispatches += effect.dispatches;
            CHECK(effect.milliseconds >= 0);
        }
        CHECK(dispatches == timed.plan().passes.size());
        CHECK(same(plain.state(), timed.state()));
    }
}

TEST_CASE("an empty scene steps and has nothing to show (C08)")
{
    for (const std::string& device : test_devices())
    {
        World world(Scene{}, test_device(device));
        const auto before = world.device().counters().dispatches;
        world.step();
        CHECK(world.device().counters().dispatches == before);
        CHECK(world.positions().empty());
        CHECK(measure(world).status == Status::completed);
    }
}

TEST_CASE("moving pins are where their keyframes say, held ones do not move by a bit")
{
    for (const std::string& device : test_devices())
    {
        INFO(device);
        World world(test::everything(), test_device(device));
        const auto start = world.positions();
        for (int i = 0; i < 30; ++i)
            world.step();
        CHECK(world.positions()[0].y - start[0].y == Approx(0.15).margin(1e-6));
        World still(test::hanging(), test_device(device));
        const auto before = still.positions();
        for (int i = 0; i < 30; ++i)
            still.step();
        CHECK(still.positions()[0] == before[0]);
        CHECK(still.positions()[8] == before[8]);
    }
}
