// Meshes that are led into cloth at any speed never pass it with the guarantee (docs/contact.md): steps in
// which they would are done again in parts (src/world/refined_step.cpp). Judged by src/judge.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/expect.hpp"
#include "support/judged_run.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"
#include "support/thrown_run.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace taut;

namespace {

constexpr double kWay = 0.3; ///< m, that the plate goes up: the sheet is long enough to follow

/// A plate that is led up into a sheet held by one edge, which it strikes after 2 cm.
Scene struck_sheet(double speed)
{
    Body plate = test::level_sheet(6, 0.2, {0, -0.02, 0}, 0.004);
    Body sheet = test::level_sheet(10, 0.4, {0.003, 0, 0.002}, 0.004);
    sheet.material.stretch_stiffness = 3000;
    sheet.contact.self = true;
    sheet.pins = {Pin{}};
    sheet.pins[0].use_box = true;
    sheet.pins[0].box_min = {-1, -1, 0.201};
    sheet.pins[0].box_max = {1, 1, 0.203};
    Scene scene = test::guarded_scene({plate, sheet});
    test::hold_all(scene.bodies[0], {{0, glm::dvec3(0)}, {kWay / speed, {0, kWay, 0}}});
    return scene;
}

bool over_plate(const glm::dvec3& x) { return std::abs(x.x) < 0.09 && std::abs(x.z) < 0.09; }

/// Vertices of the sheet that were over the plate and are under it. Others may swing there round its rim.
std::size_t passed(const World& world, const std::vector<glm::dvec3>& start)
{
    const double plate = world.positions(0).front().y;
    const std::vector<glm::dvec3> now = world.positions(1);
    std::size_t below = 0;
    for (std::size_t v = 0; v < now.size(); ++v)
        below += over_plate(start[v]) && over_plate(now[v]) && now[v].y < plate ? 1 : 0;
    return below;
}

struct Struck
{
    std::size_t crossed = 0, passed = 0;
    ContactCounts counts;
};

/// Until the plate stops, and six steps more, in which the sheet may swing anywhere.
Struck strike(const Scene& scene, double speed)
{
    World world(scene, test_device("cpu:serial"));
    const std::vector<glm::dvec3> start = world.positions(1);
    Struck out;
    out.crossed = test::crossed_in(world, static_cast<int>(std::ceil(kWay / speed / scene.timestep)));
    out.passed = passed(world, start);
    out.crossed += test::crossed_in(world, 6);
    out.counts = world.contacts();
    return out;
}

} // namespace

TEST_CASE("cloth that a plate is led into at any speed ends on its side, under every method")
{
    const double speed = GENERATE(3.0, 15.0, 60.0);
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler", "mass_spring");
    CAPTURE(speed, method);
    Scene scene = test::under(struck_sheet(speed), method);
    scene.method.substeps = method == "mass_spring" ? 40 : 10;
    const Struck guarded = strike(scene, speed);
    CAPTURE(guarded.counts.refined, guarded.counts.filtered);
    CHECK(guarded.crossed == 0);
    CHECK(guarded.passed == 0);
    CHECK(guarded.counts.pinched == 0);
    CHECK((speed < 50 || guarded.counts.refined > 0));
    scene.contact.guarantee = Guarantee::none;
    const Struck free = strike(scene, speed);
    CHECK((speed < 5 || free.crossed + free.passed > 0));
}

TEST_CASE("steps in parts take what a program moves as they take keyframes")
{
    const double speed = 9; // for two steps
    const Scene by_keys = struck_sheet(speed);
    Scene by_program = by_keys;
    by_program.bodies[0].pins[0].motion.clear();
    by_program.bodies[0].pins[0].moved_by_program = true;
    World keys(by_keys, test_device("cpu:serial")), program(by_program, test_device("cpu:serial"));
    const auto rest = program.pin_targets();
    for (int step = 1; step <= 4; ++step)
    {
        const double way = std::min(kWay, speed * step * by_keys.timestep);
        auto targets = rest;
        for (glm::dvec3& x : targets)
            x.y += way;
        program.set_pin_targets(targets);
        keys.step();
        program.step();
    }
    CHECK(keys.contacts().refined > 0);
    CHECK(program.contacts().refined == keys.contacts().refined);
    const auto a = keys.positions(), b = program.positions();
    double off = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        off = std::max(off, glm::distance(a[v], b[v]));
    CHECK(off < 1e-6);
}

TEST_CASE("a state between steps in parts goes on as the run did, bit for bit")
{
    const Scene scene = struck_sheet(9); // for two steps
    World whole(scene, test_device("cpu:serial")), again(scene, test_device("cpu:serial"));
    whole.step();
    again.restore(whole.state());
    for (int step = 0; step < 3; ++step)
    {
        whole.step();
        again.step();
        CHECK(again.positions() == whole.positions());
        CHECK(again.velocities() == whole.velocities());
    }
    CHECK(again.contacts().refined > 0);
    CHECK(whole.scene().timestep == scene.timestep);
}

TEST_CASE("forces of contact are those of the substep, in parts, too")
{
    const Scene scene = struck_sheet(9);
    World world(scene, test_device("cpu:serial"));
    world.step();
    REQUIRE(world.contacts().refined > 0);
    CHECK(world.predictions().empty());
    // The same in steps of the substep that the parts have.
    Scene finer = scene;
    finer.timestep = scene.timestep / 4;
    World fine(finer, test_device("cpu:serial"));
    for (int step = 0; step < 4; ++step)
        fine.step();
    REQUIRE(fine.contacts().refined == 0);
    double push = 0, expected = 0;
    for (const BodyContactForce& f : fine.contact_forces())
        expected += f.a == 0 ? f.push : 0;
    for (const BodyContactForce& f : world.contact_forces())
        push += f.a == 0 ? f.push : 0;
    CHECK(expected > 1);
    CHECK(push == Approx(expected).epsilon(0.5));
}

TEST_CASE("steps in parts are the same bit for bit on every executor")
{
    const Scene scene = struck_sheet(30);
    std::uint64_t hash = 0;
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        World world(scene, device);
        for (int step = 0; step < 3; ++step)
            world.step();
        INFO(selector);
        CHECK(world.contacts().refined > 0);
        const std::uint64_t own = measure(world).position_hash;
        hash = hash == 0 ? own : hash;
        if (conformance::bitwise_equal_expected(device->info()))
            CHECK(own == hash);
    }
}

TEST_CASE("what has no place left is tried in parts ever more seldom")
{
    // Twisted by more than it has length for.
    Body strip = test::level_sheet(9, 0.4, glm::dvec3(0), 0.01);
    strip.material.stretch_stiffness = 5000;
    strip.material.bending_stiffness = 1e-4;
    strip.contact.self = true;
    strip.pins.resize(2);
    for (Pin& pin : strip.pins)
        pin.use_box = true;
    strip.pins[0].box_min = {-0.3, -1, -1};
    strip.pins[0].box_max = {-0.19, 1, 1};
    strip.pins[1].box_min = {0.19, -1, -1};
    strip.pins[1].box_max = {0.3, 1, 1};
    strip.pins[1].motion = {{0, glm::dvec3(0)}, {0.7, {-0.2, 0, 0}, {1, 0, 0}, 440}};
    Scene scene = test::under(test::guarded_scene({strip}), "implicit_euler");
    scene.contact.sweeps = 1;
    scene.method.substeps = 1;
    scene.method.precision = Precision::float64;
    World world(scene, test_device("cpu:serial"));
    std::uint64_t pinched_steps = 0, before = 0;
    std::uint32_t times = 0;
    for (int step = 0; step < 44; ++step)
    {
        world.step();
        const std::uint64_t now = world.contacts().pinched;
        pinched_steps += now > before ? 1 : 0;
        before = now;
        times = std::max(times, world.state().given_up.times);
    }
    CAPTURE(pinched_steps, world.contacts().refined);
    REQUIRE(pinched_steps > 5);
    CHECK(world.contacts().refined < pinched_steps);
    CHECK(times > 1);
    CHECK(world.events().non_finite == 0);
}

namespace {

/// A sleeve between limbs that go so far towards each other, m.
Scene squeezed(double way)
{
    Scene scene = suite("38_elbow");
    scene.method.substeps = 4;
    scene.bodies[2].shape.cells = {8, 8};
    for (int limb : {0, 1})
        for (Keyframe& key : scene.bodies[static_cast<std::size_t>(limb)].kinematic.motion)
            key.translate *= way / 0.1025;
    return resolve(scene);
}

/// One of which some does not open by itself.
Scene tangled()
{
    for (const double way : {0.12, 0.125, 0.13, 0.135, 0.14, 0.145, 0.15})
    {
        World world(squeezed(way), test_device("cpu:serial"));
        for (int step = 0; step < 40; ++step)
            world.step();
        if (world.contacts().untangled > 0)
            return world.scene();
    }
    FAIL("all of them open by themselves");
    return {};
}

} // namespace

TEST_CASE("what a pinch has left crossed is taken apart once it is over, bit for bit everywhere")
{
    const Scene scene = tangled();
    std::uint64_t hash = 0;
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        World world(scene, device), again(scene, device);
        const test::Meant meant(world.scene());
        const judging::Judge judge(meant.all.triangles, world.positions());
        const auto crossed = [&] { return met_between(meant, judge, world.positions(), world.positions()); };
        std::size_t most = 0;
        for (int step = 0; step < 40; ++step)
        {
            if (step == 24) // within the pinch
            {
                CHECK(world.state().given_up.tangled);
                again.restore(world.state());
            }
            world.step();
            most = std::max(most, crossed());
        }
        INFO(selector);
        CHECK(most > 0);
        CHECK(crossed() == 0);
        CHECK(world.contacts().untangled > 0);
        for (int step = 24; step < 40; ++step)
            again.step();
        CHECK(again.positions() == world.positions());
        const std::uint64_t own = measure(world).position_hash;
        hash = hash == 0 ? own : hash;
        if (conformance::bitwise_equal_expected(device->info()))
            CHECK(own == hash);
    }
}
