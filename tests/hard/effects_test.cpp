// Effects under hard conditions: capsules and boxes (methods 2.E E01 to E04, E10, E11, E13), an extreme pull
// with a strain limit (F13), gusts, and pins drawn apart beyond the cloth's length.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Collider capsule(const glm::dvec3& from, const glm::dvec3& to, double radius, double friction = 0)
{
    Collider c;
    c.kind = ColliderKind::capsule;
    c.point = from;
    c.end = to;
    c.radius = radius;
    c.friction = friction;
    return c;
}

Collider box(const glm::dvec3& centre, const glm::dvec3& half, double friction = 0)
{
    Collider c;
    c.kind = ColliderKind::cuboid;
    c.point = centre;
    c.half_size = half;
    c.friction = friction;
    return c;
}

/// Distance of the z axis from the way between two points, m.
double distance_from_axis(glm::dvec3 from, glm::dvec3 to)
{
    from.z = to.z = 0;
    const glm::dvec3 d = to - from;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(-glm::dot(from, d) / square, 0.0, 1.0) : 0.0;
    return glm::length(from + t * d);
}

const char* word(const Collider& c) { return c.kind == ColliderKind::capsule ? "capsule" : "box"; }

} // namespace

TEST_CASE("E01: particles of 100 m/s do not pass a thin plate or a thin rod [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        std::vector<glm::dvec3> places;
        for (int k = 0; k < 64; ++k) // many phases of the step against the surface
            places.emplace_back(0.0004 * (k % 8), 1 + 0.026 * k, 0);
        Scene scene = alone(particles(places));
        scene.bodies[0].velocity = {0, -100, 0};
        scene.bodies[0].material.thickness = 0.001;
        scene.method.substeps = 1;
        for (const Collider& c : {box({0, 0, 0}, {1, 0.001, 1}), capsule({0, 0, -1}, {0, 0, 1}, 0.004)})
        {
            scene.colliders = {c};
            World world(scene, device);
            double least = 1e9; // distance of any path between two steps from the surface, m
            auto from = world.positions();
            for (int i = 0; i < 10; ++i)
            {
                world.step();
                const auto to = world.positions();
                for (std::size_t v = 0; v < to.size(); ++v)
                    least = std::min(least, c.kind == ColliderKind::cuboid
                                                ? to[v].y - c.half_size.y
                                                : distance_from_axis(from[v], to[v]) - c.radius);
                from = to;
            }
            check_sound(world);
            note("E01", *device, (std::string("nearest to a thin ") + word(c) + ", m").c_str(), least);
            CHECK(least >= 0.001 - 1e-6);
        }
    });
}

TEST_CASE("E02: a square between two boxes a hair wider slides on, and stays between [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(4, 1e4, 1e-3);
        scene.bodies[0].material.thickness = 0.001;
        scene.bodies[0].velocity = {10, 0, 0};
        const double half = 0.001 + 0.5e-4; // of the space between them
        scene.colliders = {box({0, 0, -half - 1}, {100, 2, 1}), box({0, 0, half + 1}, {100, 2, 1})};
        World world(scene, device);
        run(world, 60);
        const StepReport report = check_sound(world);
        double speed = 0;
        for (const glm::dvec3& v : world.velocities())
            speed += v.x / double(world.velocities().size());
        note("E02", *device, "speed along boxes after 1 s / 10 m/s", speed / 10);
        CHECK(report.penetration == 0);
        CHECK(speed == Approx(10).epsilon(0.01));
    });
}

TEST_CASE("E03: a capsule and a box of 20 m/s into hanging cloth leave no vertex inside [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        const double size = 5.0 / 12;
        for (Collider c : {capsule({-0.3, -0.1, 1.5}, {0.3, -0.1, 1.5}, size, 0.2),
                           box({0, -0.1, 1.5}, {size, size, size}, 0.2)})
        {
            Scene scene = test::hanging(12);
            scene.bodies[0].material.bending_stiffness = 1e-4;
            c.motion = {{0, {0, 0, 0}}, {0.09, {0, 0, -1.8}}};
            scene.colliders = {c};
            World world(scene, device);
            double deepest = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                if (i % 5 == 4 || i < 12)
                    deepest = std::max(deepest, measure(world).penetration);
            }
            check_sound(world);
            note("E03", *device, (std::string("deepest vertex on the way / size, ") + word(c)).c_str(),
                 deepest / size);
            CHECK(deepest < 0.01 * size);
        }
    });
}

TEST_CASE("E04: what starts inside a capsule or a box leaves it slowly and completely [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        const double d = std::sqrt(2.0);
        for (const Collider& c : {capsule({0, -2, -1 + 0.1 * d}, {0, 2, -1 + 0.1 * d}, 1),
                                  box({0, 0, -1 + 0.1 * d}, {2, 2, 1})})
        {
            Scene scene = free_cloth(6, 1000, 1e-4);
            scene.gravity = {0, 0, -9.81};
            scene.colliders = {c};
            World world(scene, device);
            double fastest = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                const auto v = world.velocities();
                double mean = 0;
                for (const glm::dvec3& u : v)
                    mean += u.z / double(v.size());
                fastest = std::max(fastest, mean);
            }
            const StepReport report = check_sound(world);
            note("E04", *device, (std::string("exit speed, m/s, ") + word(c)).c_str(), fastest);
            CHECK(fastest > 0);
            CHECK(fastest < std::sqrt(2 * 9.81 * 0.1 * d));
            CHECK(report.penetration < 0.01 * d);
        }
    });
}

TEST_CASE("E10: a pinned vertex inside a capsule or a box stays and is counted [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        for (const bool round : {true, false})
        {
            Scene scene = test::hanging(6);
            scene.bodies[0].material.bending_stiffness = 1e-4;
            scene.damping = 2;
            const glm::dvec3 at = scene.bodies[0].mesh.positions[0] + glm::dvec3(0.02, 0.02, 0);
            scene.colliders = {round ? capsule(at, at + glm::dvec3(0, 0.5, 0), 0.1, 0.3)
                                     : box(at, {0.1, 0.1, 0.1}, 0.3)};
            World world(scene, device);
            const auto start = world.positions();
            const int steps = steps_for(*device, 480, 240);
            run(world, steps);
            const StepReport report = check_sound(world, {"conflict"});
            CHECK(report.warnings.at("conflict") == std::uint64_t(steps));
            CHECK(world.positions()[0] == start[0]);
            const double jitter = report.max_speed / std::sqrt(9.81 * std::sqrt(2.0));
            note("E10", *device, round ? "speed / sqrt(g D), capsule" : "speed / sqrt(g D), box", jitter);
            CHECK(jitter < (steps == 480 ? 1e-3 : 1e-2));
            CHECK(report.penetration < 1e-6);
        }
    });
}

TEST_CASE("E11: a box's corner and a spike bear cloth that falls on them [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        for (const bool spike : {false, true})
        {
            Scene scene = free_cloth(10, 1000, 1e-4);
            for (glm::dvec3& x : scene.bodies[0].mesh.positions) // lying
                x = {x.x, 0.1, -x.y};
            scene.gravity = {0, -9.81, 0};
            Collider c = spike ? capsule({0.013, -1, 0.007}, {0.013, 0, 0.007}, 1e-3, 0.3)
                               : box({0, -0.44, 0}, {0.25, 0.25, 0.25}, 0.3);
            c.rotate_axis = {1, 0, -1}; // a corner upwards
            c.rotate_degrees = spike ? 0 : 54.7356;
            scene.colliders = {c};
            World world(scene, device);
            double deepest = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                if (i % 10 == 9)
                    deepest = std::max(deepest, measure(world).penetration);
            }
            check_sound(world);
            double fall = 0; // m, of the mean: 4.9 without contact, half a metre where it hangs over
            for (const glm::dvec3& x : world.positions())
                fall += (0.1 - x.y) / double(world.positions().size());
            note("E11", *device, spike ? "depth / D, spike" : "depth / D, corner", deepest / std::sqrt(2.0));
            note("E11", *device, spike ? "fall, m, spike" : "fall, m, corner", fall);
            CHECK(deepest < 0.01 * std::sqrt(2.0));
            CHECK(fall < 0.7);
        }
    });
}

TEST_CASE("E13: colliders that spin with 50 rad/s give cloth no more than their speed [hard]", "[effects]")
{
    on_every_device([](const auto& device) {
        for (const bool round : {true, false})
        {
            Scene scene = free_cloth(8, 1000, 1e-4);
            for (glm::dvec3& x : scene.bodies[0].mesh.positions)
                x = {x.x, 0.32, -x.y};
            scene.gravity = {0, -9.81, 0};
            Collider c = round ? capsule({-0.2, 0, 0}, {0.2, 0, 0}, 0.1, 0.5)
                               : box({0, 0, 0}, {0.2, 0.1, 0.1}, 0.5);
            const double degrees = 50 * 57.29577951308232;
            c.motion = {{0, {0, 0, 0}, {0, 0, 1}, 0}, {1, {0, 0, 0}, {0, 0, 1}, degrees}};
            scene.colliders = {c};
            World world(scene, device);
            double fastest = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                const auto v = world.velocities();
                glm::dvec3 mean(0);
                for (const glm::dvec3& u : v)
                    mean += u / double(v.size());
                fastest = std::max(fastest, glm::length(mean));
            }
            check_sound(world);
            const double most = 50 * (round ? 0.301 : std::hypot(0.201, 0.101)); // of a point of its surface
            note("E13", *device, round ? "speed of the cloth / of the tip, capsule" : "the same, box",
                 fastest / most);
            CHECK(fastest < most + 9.81);
        }
    });
}

TEST_CASE("F13: a corner drawn away ten times the cloth's size in a second, with a strain limit [hard]",
          "[effects]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(8);
        scene.bodies[0].material.strain_limit = 0.1;
        scene.bodies[0].pins.resize(1);
        scene.bodies[0].pins[0].vertices = {0};
        scene.bodies[0].pins[0].motion = {{0, {0, 0, 0}}, {1, {0, 0, 10}}};
        for (const std::uint32_t iterations : {1u, 8u})
        {
            scene.method.iterations = iterations;
            World world(scene, device);
            double stretch = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                stretch = std::max(stretch, measure(world).max_stretch);
            }
            check_sound(world);
            note("F13", *device, iterations == 1 ? "stretch, limit 0.1, 1 iteration" : "the same, 8",
                 stretch);
            CHECK(stretch < (iterations == 1 ? 0.25 : 0.12));
        }
    });
}

TEST_CASE("a flag of light cloth in a gust of 50 m/s stays finite and no faster than the air [hard]",
          "[effects]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(8);
        Body& flag = scene.bodies[0];
        flag.material.density = 0.05;
        flag.material.bending_stiffness = 1e-5;
        flag.material.drag = 1.2;
        flag.material.friction_drag = 0.05;
        flag.pins[0].vertices.clear();
        for (std::uint32_t row = 0; row < 9; ++row)
            flag.pins[0].vertices.push_back(9 * row);
        scene.wind.density = 1.2;
        scene.wind.keys = {{0, {2, 0, 0.5}}, {0.4, {2, 0, 0.5}}, {0.45, {35, 0, 35}}, {1, {35, 10, -35}}};
        World world(scene, device);
        double fastest = 0, stretch = 0;
        for (int i = 0; i < 60; ++i)
        {
            world.step();
            const StepReport report = measure(world);
            fastest = std::max(fastest, report.max_speed);
            stretch = std::max(stretch, report.max_stretch);
        }
        check_sound(world);
        note("gust", *device, "fastest vertex, m/s", fastest);
        note("gust", *device, "largest stretch", stretch);
        CHECK(fastest > 5);
        CHECK(fastest < 75); // a whip's end may outrun the air, not by much
        CHECK(stretch < 1);
    });
}

TEST_CASE("pins drawn apart beyond the cloth's length: finite, stretched, and torn where it may tear [hard]",
          "[effects]")
{
    on_every_device([](const auto& device) {
        for (const bool tears : {false, true})
        {
            Scene scene = test::hanging(8);
            Body& body = scene.bodies[0];
            body.material.attachment_slack = 0.1;
            body.material.tear_strain = tears ? 0.5 : 0;
            Pin left = hold({0}), right = hold({8});
            right.motion = {{0, {0, 0, 0}}, {0.5, {3, 0, 0}}};
            body.pins = {left, right};
            World world(scene, device);
            run(world, 60);
            const StepReport report = check_sound(world);
            const auto x = world.positions();
            CHECK(glm::distance(x[0], x[8]) == Approx(4).epsilon(1e-6));
            note("apart", *device, tears ? "largest stretch, torn" : "largest stretch, whole",
                 report.max_stretch);
            if (tears)
                CHECK(report.torn > 0);
            else
                CHECK(report.max_stretch > 1);
            CHECK(report.max_stretch < 40);
        }
    });
}
