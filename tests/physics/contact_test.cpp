// Cloth that meets cloth (docs/contact.md): stays above it, keeps momentum, rubs, and never ends within it.

#include "conformance/tolerances.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/expect.hpp"
#include "support/mean.hpp"
#include "support/nearest.hpp"
#include "support/sheets.hpp"

#include "taut/report/report.hpp"
#include "taut/world/hybrid.hpp"
#include "taut/world/sleep.hpp"
#include "taut/world/split.hpp"
#include "taut/world/world.hpp"

#include <glm/trigonometric.hpp>

#include <string>
#include <vector>

using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius;

Body sheet(std::uint32_t cells, double size, const glm::dvec3& centre)
{
    return test::level_sheet(cells, size, centre, kRadius);
}

void pin_all(Body& body)
{
    Pin pin;
    pin.edges = {"top", "bottom", "left", "right"};
    pin.box_min = glm::dvec3(-10);
    pin.box_max = glm::dvec3(10);
    pin.use_box = true;
    body.pins = {pin};
}

/// A sheet `height` above a held one that is larger and not of the same cells.
Scene two_sheets(double height)
{
    Scene scene;
    scene.bodies = {sheet(10, 0.3, {0, 0, 0}), sheet(7, 0.15, {0.011, height, 0.007})};
    pin_all(scene.bodies[0]);
    scene.contact.between = true;
    scene.method.substeps = 15;
    return scene;
}

std::vector<glm::dvec3> places_of(const World& world, std::size_t body)
{
    const auto x = world.positions();
    const auto& start = world.plan().body_start;
    return {x.begin() + start[body], x.begin() + start[body + 1]};
}

double lowest(const std::vector<glm::dvec3>& x)
{
    double low = x.front().y;
    for (const glm::dvec3& p : x)
        low = std::min(low, p.y);
    return low;
}

} // namespace

TEST_CASE("a sheet that falls on a held one comes to rest a gap above it")
{
    World world(two_sheets(0.03), test_device("cpu:serial"));
    const auto triangles = test::all_triangles(world.scene());
    std::size_t crossed = 0;
    double low = 1;
    for (int step = 0; step < 120; ++step)
    {
        world.step();
        low = std::min(low, lowest(places_of(world, 1)));
        crossed += test::intersections(triangles, world.positions());
    }
    CHECK(crossed == 0);
    CHECK(low > 0.9 * kGap); // it met the other at some 0.75 m/s
    const auto rest = places_of(world, 1);
    for (const glm::dvec3& p : rest)
        CHECK(std::abs(p.y - kGap) < 0.05 * kGap);
    const StepReport report = measure(world);
    CHECK(report.contacts.pairs > 0);
    CHECK(report.contacts.missing + report.contacts.cut + report.contacts.crowded == 0);
    CHECK(report.contact_depth < 0.05 * kGap);
    CHECK(report.status == Status::completed);
}

TEST_CASE("without contact the same sheet falls through")
{
    Scene scene = two_sheets(0.03);
    scene.contact.between = false;
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 120; ++step)
        world.step();
    CHECK(lowest(places_of(world, 1)) < -1);
    CHECK(!world.contacts().any);
    CHECK(world.contact_pairs().empty());
}

TEST_CASE("two free sheets that collide keep their momentum, and stay apart")
{
    const double speed = GENERATE(0.5, 2.0);
    CAPTURE(speed);
    Scene scene;
    scene.bodies = {sheet(8, 0.2, {0, 0, 0}), sheet(5, 0.15, {0.013, 0.02, 0.004})};
    scene.bodies[1].velocity = {0.1, -speed, 0};
    scene.bodies[1].material.density = 0.5;
    for (Body& body : scene.bodies)
    {
        body.material.bending_stiffness = 1e-5;
        body.contact.self = true; // they fold
    }
    scene.contact.between = true;
    scene.contact.friction = 0.3;
    scene.gravity = glm::dvec3(0);
    scene.method.substeps = 20;
    World world(scene, test_device("cpu:serial"));
    const StepReport before = measure(world);
    CHECK(test::crossed_in(world, 60) == 0);
    const StepReport after = measure(world);
    CHECK(after.momentum_error >= 0);
    CHECK(after.momentum_error < 2e-6);
    CHECK(after.kinetic_energy < before.kinetic_energy);
    // The lower one was at rest, and nothing else could move it.
    CHECK(test::mean(places_of(world, 0)).y < -0.05 * speed);
}

TEST_CASE("a sheet on a tilted one stays below the angle of friction and slides above it as a block does")
{
    const double degrees = 20, angle = glm::radians(degrees), limit = std::tan(angle);
    const double friction = GENERATE_COPY(0.5 * limit, 0.8 * limit, 1.25 * limit);
    CAPTURE(friction, limit);
    Scene scene;
    scene.bodies = {sheet(12, 0.6, {0, 0, 0}), sheet(5, 0.1, {0.003, kGap, 0.1})};
    pin_all(scene.bodies[0]);
    scene.contact.between = true;
    scene.contact.friction = friction;
    scene.method.substeps = 20;
    scene.gravity = 9.81 * glm::dvec3(0, -std::cos(angle), -std::sin(angle)); // tilted by turning gravity
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 6; ++step)
        world.step(); // the start has no load
    const glm::dvec3 from = test::mean(places_of(world, 1));
    const double t0 = world.time();
    for (int step = 0; step < 12; ++step)
        world.step();
    const double t1 = world.time();
    const double way = from.z - test::mean(places_of(world, 1)).z;
    const double pull = std::max(0.0, 9.81 * (std::sin(angle) - friction * std::cos(angle)));
    const double expected = 0.5 * pull * (t1 * t1 - t0 * t0);
    CHECK(std::abs(way - expected) < (pull > 0 ? 0.03 * expected : 1e-4));
}

TEST_CASE("lists that are too short are counted, grow, and then miss nothing")
{
    Scene scene = two_sheets(0.004); // near from the first step on
    scene.contact.searches = 1;
    scene.contact.friction = 0.3;
    WorldOptions options;
    options.plan.contact_capacity = 8;
    World small(scene, test_device("cpu:serial"), options);
    World roomy(scene, test_device("cpu:serial"));
    small.step();
    roomy.step();
    const ContactCounts first = small.contacts(), full = roomy.contacts();
    CHECK(full.pairs > 500);
    CHECK(first.pairs > full.pairs * 9 / 10); // what is not listed does not push, so more come near
    CHECK(first.missing >= first.pairs - 8);  // of each search of the step
    CHECK(first.capacity > 2 * first.pairs);
    small.step();
    CHECK(small.contacts().missing == first.missing);
    CHECK(full.missing == 0);
}

TEST_CASE("a list lasts while vertices are where they were expected, and not where they are put elsewhere")
{
    Scene scene = two_sheets(0.004);
    const bool guarded = GENERATE(false, true), doubles = GENERATE(false, true);
    CAPTURE(guarded, doubles);
    scene.gravity = glm::dvec3(0);
    scene.contact.searches = 2;
    scene.contact.guarantee = guarded ? Guarantee::no_crossing : Guarantee::none;
    scene.method.precision = doubles ? Precision::float64 : Precision::float32;
    World world(scene, test_device("cpu:serial"));
    const auto searches_of = [&](int steps) {
        const std::uint64_t before = world.contacts().searches;
        for (int k = 0; k < steps; ++k)
            world.step();
        return world.contacts().searches - before;
    };
    CHECK(searches_of(5) == 1);
    world.set_positions(world.positions());
    CHECK(searches_of(5) == 1);
    world.set_velocities(std::vector<glm::dvec3>(world.positions().size(), glm::dvec3(0, 3, 0)));
    const std::uint64_t substeps = 5 * world.plan().substeps, moving = searches_of(5);
    CHECK(moving >= 8); // half a step ahead, and then on
    CHECK(moving < substeps / 2);
}

TEST_CASE("lists that an early search of a step overflows grow, too")
{
    // They come near and part again within a step: the last of its searches finds less.
    Scene scene = two_sheets(0.02);
    scene.timestep = 0.1;
    scene.gravity = glm::dvec3(0);
    scene.contact.searches = 10;
    scene.bodies[1].velocity = {0, -2, 0};
    WorldOptions options;
    options.plan.contact_capacity = 64;
    World world(scene, test_device("cpu:serial"), options);
    for (int step = 0; step < 3 && world.contacts().missing == 0; ++step)
        world.step();
    const ContactCounts counts = world.contacts();
    REQUIRE(counts.missing > 0);
    CHECK(counts.capacity > 64);
}

TEST_CASE("a state of a world with long lists goes on in one with short lists, bit for bit")
{
    Scene scene = two_sheets(0.004);
    WorldOptions options;
    options.plan.contact_capacity = 8;
    World grown(scene, test_device("cpu:serial"), options);
    grown.step();
    const WorldState state = grown.state();
    World fresh(scene, test_device("cpu:serial"), options);
    fresh.restore(state);
    CHECK(fresh.contacts().capacity == grown.contacts().capacity);
    for (int step = 0; step < 5; ++step)
    {
        grown.step();
        fresh.step();
    }
    CHECK(fresh.positions() == grown.positions());
    WorldState wrong = state;
    wrong.contact_capacity = 1u << 30;
    CHECK_THROWS_AS(fresh.restore(wrong), Error);
}

TEST_CASE("lists that grow in time change nothing")
{
    Scene scene = two_sheets(0.08);
    scene.bodies[1].transform.rotate_degrees = -45; // meets the other one row after another
    WorldOptions options;
    options.plan.contact_capacity = 512;
    World small(scene, test_device("cpu:serial"), options);
    World roomy(scene, test_device("cpu:serial"));
    for (int step = 0; step < 30; ++step)
    {
        small.step();
        roomy.step();
    }
    REQUIRE(small.contacts().missing == 0);
    CHECK(small.contacts().capacity > 512);
    CHECK(measure(small).position_hash == measure(roomy).position_hash);
    CHECK(small.positions() == roomy.positions());
}

TEST_CASE("contact is the same bit for bit on every executor")
{
    Scene scene = two_sheets(0.01);
    scene.contact.friction = 0.4;
    scene.bodies[1].contact.self = true;
    scene.bodies[1].velocity = {0.3, -0.5, 0.1};
    scene.method.precision = GENERATE(Precision::float32, Precision::float64);
    std::uint64_t hash = 0;
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (scene.method.precision == Precision::float64 && !device->limits().float64)
            continue;
        World world(scene, device);
        for (int step = 0; step < 8; ++step)
            world.step();
        const StepReport report = measure(world);
        INFO(selector);
        CHECK(report.contacts.pairs > 0);
        hash = hash == 0 ? report.position_hash : hash;
        if (conformance::bitwise_equal_expected(device->info()))
            CHECK(report.position_hash == hash);
    }
}

TEST_CASE("a state with contact goes on bit for bit")
{
    Scene scene = two_sheets(0.01);
    scene.contact.friction = 0.4;
    World one(scene, test_device("cpu:serial")), other(scene, test_device("cpu:serial"));
    for (int step = 0; step < 5; ++step)
        one.step();
    other.restore(one.state());
    for (int step = 0; step < 5; ++step)
    {
        one.step();
        other.step();
    }
    REQUIRE(one.contacts().pairs > 0);
    CHECK(measure(one).position_hash == measure(other).position_hash);
}

TEST_CASE("worlds that divide bodies refuse those that meet, and those that let them sleep the guarantee")
{
    Scene scene = two_sheets(0.01);
    const auto device = test_device("cpu:serial");
    const auto refusal = [](auto make) -> std::string {
        try
        {
            make();
        }
        catch (const Error& error)
        {
            return error.code() == ErrorCode::unsupported ? error.what() : "another code";
        }
        return "";
    };
    CHECK_THAT(refusal([&] { HybridWorld(resolve(scene), device, test_device("cpu")); }),
               Contains("hybrid") && Contains("leave contact out"));
    CHECK_THAT(refusal([&] { SplitWorld(resolve(scene), device, test_device("cpu")); }),
               Contains("cannot be cut") && Contains("leave contact out"));
    CHECK(refusal([&] { SleepWorld(resolve(scene), device); }).empty());
    scene.contact.guarantee = Guarantee::no_crossing;
    CHECK_THAT(refusal([&] { SleepWorld(resolve(scene), device); }), Contains("contact.guarantee"));
}

TEST_CASE("the napkin of the example lands on the hammock without a triangle in another")
{
    World world(load_scene(TAUT_SOURCE_DIR "/examples/scenes/cloth_on_cloth.json"), test_device("cpu"));
    const auto triangles = test::all_triangles(world.scene());
    for (int step = 0; step < 48; ++step) // it has met the hammock all over by then
    {
        world.step();
        if (step % 4 == 3)
            CHECK(test::intersections(triangles, world.positions()) == 0);
    }
    CHECK(world.contacts().pairs > 2000);
    CHECK(test::mean(places_of(world, 1)).y > test::mean(places_of(world, 0)).y - 0.1);
}
