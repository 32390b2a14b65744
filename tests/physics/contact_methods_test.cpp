// Surfaces that meet under every method (docs/contact.md): what xpbd is held to in contact_test.cpp and
// guarantee_test.cpp, in small.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/mean.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius;

Body sheet(std::uint32_t cells, double size, const glm::dvec3& centre)
{
    Body body = test::level_sheet(cells, size, centre, kRadius);
    body.material.stretch_stiffness = 100;
    return body;
}

Scene meeting(std::vector<Body> bodies)
{
    Scene scene;
    scene.bodies = std::move(bodies);
    scene.contact.between = true;
    scene.method.substeps = 15;
    return scene;
}

/// Every method, acad too: contact does not ask for what it holds by itself.
std::string any_method()
{
    return GENERATE(
        from_range(std::vector<std::string>(kWords<MethodKind>.begin(), kWords<MethodKind>.end())));
}

} // namespace

TEST_CASE("a sheet falls on a held one and rests a gap above it, under every method")
{
    const std::string method = any_method();
    CAPTURE(method);
    Scene scene =
        test::under(meeting({sheet(8, 0.24, {0, 0, 0}), sheet(4, 0.1, {0.011, 0.02, 0.007})}), method);
    test::hold_all(scene.bodies[0]);
    World world(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(world, 60) == 0);
    for (const glm::dvec3& x : world.positions(1))
        CHECK(std::abs(x.y - kGap) < 0.1 * kGap);
    CHECK(measure(world).status == Status::completed);
    // Of each body what is above it: its weight.
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    const double weight = scene.bodies[1].material.density * 0.1 * 0.1 * 9.81;
    CHECK(std::abs(-forces[0].force.y - weight) < 0.05 * weight);
}

TEST_CASE("two free sheets that collide keep their momentum, under every method")
{
    const std::string method = any_method();
    CAPTURE(method);
    Scene scene =
        test::under(meeting({sheet(6, 0.15, {0, 0, 0}), sheet(4, 0.1, {0.013, 0.02, 0.004})}), method);
    scene.bodies[1].velocity = {0.1, -1, 0};
    scene.bodies[1].material.density = 0.5;
    for (Body& body : scene.bodies)
        body.contact.self = true; // they fold
    scene.gravity = glm::dvec3(0);
    World world(scene, test_device("cpu:serial"));
    const StepReport before = measure(world);
    CHECK(test::crossed_in(world, 30) == 0);
    const StepReport after = measure(world);
    CHECK(after.momentum_error >= 0);
    CHECK(after.momentum_error < 1e-5);
    CHECK(after.kinetic_energy < 1.001 * before.kinetic_energy);
    // The lower one was at rest, and nothing else could move it.
    CHECK(test::mean(world.velocities(0)).y < -0.05);
}

TEST_CASE("a sheet stays on a slope below the angle of friction and slides above it, under every method")
{
    const std::string method = any_method();
    const double friction = GENERATE(0.6, 0.2); // tan 20 degrees = 0.36
    CAPTURE(method, friction);
    Scene scene = test::under(meeting({sheet(8, 0.3, {0, 0, 0}), sheet(3, 0.06, {0, kGap, 0})}), method);
    test::hold_all(scene.bodies[0]);
    scene.contact.friction = friction;
    scene.contact.sweeps = 8;
    const double slope = glm::radians(20.0);
    scene.gravity = 9.81 * glm::dvec3(std::sin(slope), -std::cos(slope), 0);
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 30; ++step)
        world.step();
    const double way = test::mean(world.positions(1)).x, time = world.time();
    const double slides = 0.5 * 9.81 * (std::sin(slope) - friction * std::cos(slope)) * time * time;
    if (friction > 0.36)
        CHECK(std::abs(way) < 0.001);
    else
        CHECK(std::abs(way - slides) < 0.05 * slides);
}
