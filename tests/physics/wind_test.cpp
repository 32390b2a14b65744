// Claims about air on cloth, under every method.

#include "hard/cases.hpp"
#include "support/methods.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

constexpr double kAir = 1.2, kDensity = 0.2;

/// A free square metre in the plane z = 0 (or lying) without gravity, in a wind.
Scene sheet(double drag, double friction_drag, const glm::dvec3& velocity, bool lying = false)
{
    Scene scene;
    Body body;
    body.shape.cells = {5, 4};
    body.material.stretch_stiffness = 1e4;
    body.material.density = kDensity;
    body.material.drag = drag;
    body.material.friction_drag = friction_drag;
    if (lying)
    {
        body.transform.rotate_axis = {1, 0, 0};
        body.transform.rotate_degrees = -90;
    }
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    scene.wind.density = kAir;
    scene.wind.velocity = velocity;
    return resolve(scene);
}

glm::dvec3 mean(const std::vector<glm::dvec3>& values)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& v : values)
        sum += v;
    return sum / double(values.size());
}

} // namespace

TEST_CASE("still air does nothing to a sheet at rest, not in the last bit", "[wind]")
{
    test::on_methods_and_devices(sheet(1, 0.1, {0, 0, 0}), [](Scene scene, const auto& device) {
        World world(scene, device);
        scene.wind.density = 0;
        World without(scene, device);
        CHECK(world.plan().wind != kNoBuffer);
        CHECK(without.plan().wind == kNoBuffer);
        run(world, 30);
        run(without, 30);
        CHECK(world.state().position == without.state().position);
        CHECK(world.state().velocity == without.state().velocity);
    });
}

TEST_CASE("a lying sheet falls at the speed at which drag is its weight", "[wind]")
{
    Scene lying = sheet(1.2, 0, {0, 0, 0}, true);
    lying.gravity = {0, -9.81, 0};
    test::on_methods_and_devices(lying, [](const Scene& scene, const auto& device) {
        const double exact = std::sqrt(2 * kDensity * 9.81 / (kAir * 1.2));
        World world(scene, device);
        run(world, 120);
        check_sound(world);
        for (const glm::dvec3& v : world.velocities())
        {
            CHECK(v.y == Approx(-exact).epsilon(0.01));
            // The corners fall behind for a moment; explicit springs do not dissipate the swing that this
            // starts within the sheet.
            CHECK(std::abs(v.x) + std::abs(v.z) <
                  (scene.method.type == MethodKind::mass_spring ? 3e-3 : 1e-3));
        }
        note("physics", *device, "terminal speed / exact", -mean(world.velocities()).y / exact);
    });
}

TEST_CASE("a sheet across or along the wind goes with it as u - u / (1 + k u t)", "[wind]")
{
    const double time = 0.5;
    for (const bool across : {true, false})
    {
        const glm::dvec3 air = across ? glm::dvec3(0, 0, 5) : glm::dvec3(3, 4, 0);
        test::on_methods_and_devices(sheet(0.9, 0.1, air), [&](const Scene& scene, const auto& device) {
            World world(scene, device);
            run(world, int(60 * time));
            check_sound(world);
            const double k = kAir * (across ? 0.9 : 0.1) / (2 * kDensity);
            const glm::dvec3 exact = air - air / (1 + k * 5 * time);
            const double error = glm::length(mean(world.velocities()) - exact) / glm::length(exact);
            note("physics", *device, across ? "across the wind, error" : "along the wind, error", error);
            CHECK(error < 1e-4);
            for (const glm::dvec3& v : world.velocities()) // no cloth is faster than the air
                CHECK(glm::dot(v, air) <= glm::dot(air, air) * (1 + 1e-5));
        });
    }
}

TEST_CASE("a wind by keys blows as it is at the time, and its momentum is what the cloth gets", "[wind]")
{
    Scene scene = sheet(1, 0, {0, 0, 0});
    scene.wind.keys = {{0, {0, 0, 0}}, {0.5, {0, 0, 0}}, {1, {0, 0, 8}}};
    const auto device = test_device("cpu:serial");
    World world(scene, device);
    run(world, 30);
    for (const glm::dvec3& v : world.velocities())
        CHECK(v == glm::dvec3(0));
    run(world, 30);
    // dv/dt = k (u - v)^2 with u = 16 (t - 1/2), by small steps.
    const double k = kAir / (2 * kDensity);
    double v = 0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i)
    {
        const double u = 8 * (i + 0.5) / steps;
        v += 0.5 / steps * k * (u - v) * std::abs(u - v);
    }
    CHECK(mean(world.velocities()).z == Approx(v).epsilon(2e-3));
}
