// Claims about capsules and boxes as colliders, under every method.

#include "hard/cases.hpp"
#include "support/methods.hpp"

#include "taut/report/reference_dynamic.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Collider capsule(const glm::dvec3& from, const glm::dvec3& to, double radius)
{
    Collider c;
    c.kind = ColliderKind::capsule;
    c.point = from;
    c.end = to;
    c.radius = radius;
    return c;
}

Collider box(const glm::dvec3& centre, const glm::dvec3& half, double degrees_about_z = 0)
{
    Collider c;
    c.kind = ColliderKind::cuboid;
    c.point = centre;
    c.half_size = half;
    c.rotate_axis = {0, 0, 1};
    c.rotate_degrees = degrees_about_z;
    return c;
}

Scene falling(const std::vector<glm::dvec3>& places, const Collider& collider)
{
    Scene scene = alone(particles(places));
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {collider};
    return scene;
}

} // namespace

TEST_CASE("what falls on a capsule or a box rests at its surface and the thickness above", "[capsule]")
{
    const Scene round = falling({{0.3, 0.7, 0}, {-0.3, 0.55, 0}}, capsule({-1, 0, 0}, {1, 0, 0}, 0.5));
    const Scene flat = falling({{0.3, 0.7, 0}, {-0.3, 0.55, 0.2}}, box({0, 0, 0}, {1, 0.5, 1}));
    for (const Scene& scene : {round, flat})
        test::on_methods_and_devices(scene, [](const Scene& s, const auto& device) {
            World world(s, device);
            run(world, 60);
            check_sound(world);
            for (const glm::dvec3& x : world.positions())
                CHECK(x.y == Approx(0.501).margin(1e-6));
            CHECK(measure(world).max_speed < 1e-4); // a rounding of half a metre, 3e-8 m, in 1/600 s
        });
}

TEST_CASE("on a tilted box friction slows by mu g cos and holds at tan", "[cuboid]")
{
    const double slope = std::atan(0.5), degrees = slope * 180 / 3.14159265358979323846;
    const glm::dvec3 down(-std::cos(slope), -std::sin(slope), 0), up(-std::sin(slope), std::cos(slope), 0);
    for (const double mu : {0.0, 0.3, 0.51})
    {
        Collider ramp = box({0, 0, 0}, {5, 0.5, 1}, degrees);
        ramp.friction = mu;
        test::on_methods_and_devices(
            falling({0.501 * up - 2.0 * down}, ramp), [&](const Scene& s, const auto& device) {
                World world(s, device);
                const glm::dvec3 start = world.positions()[0];
                run(world, 60);
                check_sound(world);
                const double exact = std::max(9.81 * (std::sin(slope) - mu * std::cos(slope)), 0.0);
                const double speed = glm::dot(world.velocities()[0], down);
                note("physics", *device, "speed down a tilted box less the exact one, m/s", speed - exact);
                CHECK(speed == Approx(exact).margin(2e-3 * 9.81));
                if (mu > 0.5)
                    CHECK(glm::distance(world.positions()[0], start) < 1e-4);
            });
    }
}

TEST_CASE("a box that moves takes along what lies on it, and a capsule that turns what it rubs", "[cuboid]")
{
    Collider belt = box({0, 0, 0}, {1, 0.5, 1});
    belt.friction = 0.5;
    belt.motion = {{0, {0, 0, 0}}, {2, {2, 0, 0}}};
    test::on_methods_and_devices(falling({{0, 0.501, 0}}, belt), [](const Scene& s, const auto& device) {
        World world(s, device);
        run(world, 60);
        check_sound(world);
        CHECK(world.velocities()[0].x == Approx(1).margin(1e-4)); // rests on it after 1/(mu g) seconds
    });
    // A roller about its own axis: 1 rad/s, so 0.5 m/s at its top.
    Collider roller = capsule({0, 0, -1}, {0, 0, 1}, 0.5);
    roller.friction = 0.5;
    roller.motion = {{0, {0, 0, 0}, {0, 0, 1}, 0}, {10, {0, 0, 0}, {0, 0, 1}, -572.957795130823}};
    test::on_methods_and_devices(falling({{0, 0.501, 0}}, roller), [](const Scene& s, const auto& device) {
        World world(s, device);
        run(world, 12); // turns by 0.2 rad: the slope there, 0.2, is within the cone
        check_sound(world);
        const glm::dvec3 x = world.positions()[0];
        const double turned = std::atan2(x.x, x.y);
        note("physics", *device, "turned along with a roller / its angle", turned / 0.2);
        CHECK(turned > 0.13); // it slips until it has the roller's speed: 0.1 s
        CHECK(turned < 0.2);
        CHECK(glm::length(world.velocities()[0]) == Approx(0.501).epsilon(0.02));
    });
}

TEST_CASE("particles over capsules and boxes follow the reference, the closer the smaller the substep",
          "[capsule]")
{
    const auto device = test_device("cpu:serial");
    Collider turned = box({0, 0, 0}, {0.4, 0.2, 0.4}, 30);
    turned.friction = 0.2;
    Collider log = capsule({-0.5, 0, 0}, {0.5, 0.1, 0}, 0.2);
    log.friction = 0.2;
    for (const Collider& collider : {turned, log})
    {
        Scene scene = falling({{0.05, 0.6, 0.05}, {-0.2, 0.5, -0.1}}, collider);
        scene.duration = 0.5;
        const PhysicalModel model = make_model(scene);
        DynamicOptions options;
        options.levels = 6;
        const DynamicReference reference = solve_dynamic(model, options);
        REQUIRE(reference.frames.size() == 31);
        double errors[2] = {};
        for (const int finer : {0, 1})
        {
            scene.method.substeps = finer ? 40 : 5;
            World world(scene, device);
            run(world, 30);
            errors[finer] = largest_distance(world.positions(), reference.frames.back());
        }
        note("physics", *device, "error against the reference, 5 substeps, m", errors[0]);
        note("physics", *device, "error against the reference, 40 substeps, m", errors[1]);
        CHECK(errors[0] < 0.03);
        CHECK(errors[1] < std::max(0.3 * errors[0], 1e-5)); // a fall that ends in rest is exact at once
    }
}
