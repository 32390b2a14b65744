// Vertex block descent: rest, units, topology, contact, extremes (methods 2.B to 2.G).

#include "hard/shared_cases.hpp"
#include "hard/vbd_cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("B16: what is at rest stays at rest under vertex block descent, from every start [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* start : {"adaptive", "inertial", "previous"})
        {
            Scene scene = by_vbd(free_cloth(6, 1e4, 1e-3));
            scene.method.start = option_named<SweepStart>(start);
            scene.bodies[0].material.stretch_damping = 1e-3;
            World world(scene, device);
            const auto before = world.positions();
            run(world, steps_for(*device, 1000, 100));
            const StepReport report = check_sound(world);
            const double drift = largest_distance(world.positions(), before) / std::sqrt(2.0);
            note("B16", *device, start, drift);
            CHECK(drift < 1e-6);
            CHECK(report.kinetic_energy < 1e-10 * 0.2 * 9.81 * std::sqrt(2.0));
        }
    });
}

TEST_CASE("B18, B19: far away and in other units vertex block descent moves cloth as here [hard]")
{
    Scene near = by_vbd(test::hanging(6));
    near.bodies[0].material.bending_stiffness = 1e-4;
    near.bodies[0].material.stretch_damping = 1e-3;
    check_far_and_in_units(near);
}

TEST_CASE("C01 to C08: fans, stars, loners and twins under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        World world(by_vbd(alone(star(1e-3)), 2, 1), device);
        const auto sweeps = std::count_if(world.plan().passes.begin(), world.plan().passes.end(),
                                          [](const Dispatch& d) { return d.kernel->name == "vbd_solve"; });
        CHECK(sweeps == 2 * 2); // substeps, colours
        run(world, 5);
        check_sound(world);

        World several(loner_and_twins(by_vbd(Scene{}, 10, 2)), device);
        run(several, 60);
        check_loner_and_twins(several);
        World nothing(by_vbd(Scene{}), device);
        nothing.step();
        CHECK(nothing.plan().passes.empty());
    });
}

TEST_CASE("E03, E05, E10: a fast ball, a floor, a pin inside, under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(free_cloth(8, 1e4, 1e-4), 10, 2);
        scene.gravity = {0, 0, -9.81};
        Collider floor;
        floor.kind = ColliderKind::plane;
        floor.normal = {0, 0, 1};
        floor.point = {0, 0, -0.01};
        floor.friction = 0.5;
        scene.colliders = {floor};
        World lying(scene, device);
        run(lying, steps_for(*device, 600, 120));
        const auto before = lying.positions();
        run(lying, 60);
        const StepReport rest = check_sound(lying);
        note("E05", *device, "jitter", rest.max_speed / std::sqrt(9.81 * std::sqrt(2.0)));
        CHECK(rest.max_speed / std::sqrt(9.81 * std::sqrt(2.0)) < 1e-3);
        CHECK(largest_distance(lying.positions(), before) < 1e-3);
        CHECK(rest.penetration < 1e-6);

        Collider ball;
        ball.point = {0, 0, -1.2};
        ball.radius = 0.3;
        ball.friction = 0.3;
        ball.motion = {{0, {0, 0, 0}}, {0.05, {0, 0, 1}}, {1, {0, 0, 1}}};
        scene.colliders = {ball};
        scene.bodies[0].pins = {hold({0, 8})};
        World hit(scene, device);
        run(hit, 60);
        const StepReport report = check_sound(hit);
        note("E03", *device, "stretch after 1 s", report.max_stretch);
        CHECK(report.penetration < 0.01 * 0.3);

        scene.colliders[0].motion.clear();
        scene.colliders[0].point = scene.bodies[0].mesh.positions[0];
        World pinned(scene, device);
        run(pinned, 60);
        check_sound(pinned, {"conflict"});
        CHECK(pinned.positions()[0] == scene.bodies[0].mesh.positions[0]);
    });
}

TEST_CASE("E06, E07: friction under vertex block descent slides and sticks as Coulomb says [hard]")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t iterations : {1u, 5u})
            for (const double friction : {0.1, 0.5})
            {
                Scene scene = by_vbd(free_cloth(2, 1e5, 1e-3), 10, iterations);
                scene.gravity = {0, 0, -9.81};
                scene.bodies[0].velocity = {10, 0, 0};
                Collider floor;
                floor.kind = ColliderKind::plane;
                floor.normal = {0, 0, 1};
                floor.point = {0, 0, -scene.bodies[0].material.thickness};
                floor.friction = friction;
                scene.colliders = {floor};
                World world(scene, device);
                const double from = world.positions()[4].x, exact = 100 / (2 * friction * 9.81);
                run(world, static_cast<int>(60 * 1.2 * 10 / (friction * 9.81)));
                const double way = world.positions()[4].x - from;
                note("E07", *device, "way / exact - 1", way / exact - 1);
                CHECK(std::abs(way - exact) < std::max(0.02 * exact, 10.0 / 60));
            }
        for (const auto& [start, friction] : std::vector<std::pair<std::string, double>>{{"adaptive", 0.49},
                                                                                         {"adaptive", 0.5},
                                                                                         {"adaptive", 0.7},
                                                                                         {"inertial", 0.49},
                                                                                         {"inertial", 0.5}})
        {
            CAPTURE(start, friction);
            const double angle = std::atan(0.5);
            Scene scene = by_vbd(free_cloth(2, 1e5, 1e-3), 10, 2);
            scene.method.start = option_named<SweepStart>(start);
            scene.gravity = {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)};
            Collider floor;
            floor.kind = ColliderKind::plane;
            floor.normal = {0, 0, 1};
            floor.point = {0, 0, -scene.bodies[0].material.thickness};
            floor.friction = friction;
            scene.colliders = {floor};
            World world(scene, device);
            const double from = world.positions()[4].x;
            run(world, 60);
            const double way = world.positions()[4].x - from;
            note("E06", *device, "way in 1 s", way);
            if (friction == 0.49)
                CHECK(way == Approx(0.043872).epsilon(0.2));
            else
                CHECK(std::abs(way) < 1e-3);
        }
    });
}

TEST_CASE("G03 to G09 under vertex block descent: blows, flips, twins, copies, halves of a run [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(test::everything(4), 4, 2);
        scene.bodies[0].material.stretch_damping = 1e-4;
        World once(scene, device), twice(scene, device), rest(scene, device);
        CHECK(refusal_of([&] { once.set_force(5, {kNaN, 0, 0}); }) == "bad_input");
        run(once, 40);
        run(twice, 17);
        rest.restore(twice.state());
        run(twice, 23);
        run(rest, 23);
        CHECK(same_state(once.state(), twice.state()));
        CHECK(same_state(once.state(), rest.state()));
        check_sound(rest);

        Scene crowd = scene, single = scene;
        single.bodies[0].pins.clear();
        crowd.bodies.clear();
        crowd.bodies.resize(3, single.bodies[0]);
        crowd.bodies.push_back(test::chain(7, 100, 0.01).bodies[0]);
        World solo(single, device), all(crowd, device);
        run(solo, 30);
        run(all, 30);
        const auto x = solo.positions(), y = all.positions();
        bool copies = true;
        for (std::size_t v = 0; v < 3 * x.size(); ++v)
            copies = copies && y[v] == x[v % x.size()];
        CHECK(copies);

        World blown(scene, device);
        run(blown, 10);
        blown.set_force(12, {0, 0, 1e6});
        run(blown, 1);
        blown.set_force(12, {0, 0, 0});
        run(blown, 120);
        CHECK(finite(blown.positions()));
        CHECK(to_string(measure(blown).status) == "completed");
        glm::dvec3 gravity = {0, -1e4, 0};
        for (int i = 0; i < 60; ++i)
        {
            blown.set_gravity(gravity);
            blown.step();
            gravity = -gravity;
        }
        CHECK(finite(blown.positions()));
        CHECK(finite(blown.velocities()));
    });
}

TEST_CASE("a Chebyshev radius that is far too high ends in no explosion, at any number of iterations [hard]")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t iterations : {4u, 8u, 12u, 30u})
            for (const double radius : {0.5, 0.99, 0.99999})
            {
                INFO(iterations << ", " << radius);
                Scene scene = by_vbd(test::everything(4), 1, iterations);
                scene.method.spectral_radius = radius;
                World world(scene, device);
                run(world, 60);
                CHECK(finite(world.positions()));
                const StepReport report = measure(world);
                CHECK(to_string(report.status) == "completed");
                CHECK(report.max_stretch < 1);
                CHECK(report.max_speed < 20);
            }
    });
}

TEST_CASE("any stiffness, any step, any start: vertex block descent stays finite [hard]")
{
    on_every_device([](const auto& device) {
        conformance::Random random(5);
        for (int draw = 0; draw < 12; ++draw)
        {
            Scene scene =
                free_cloth(4, std::pow(10.0, random.uniform(-3, 14)), std::pow(10.0, random.uniform(-8, 4)));
            scene.gravity = {0, -random.uniform(0, 1000), 0};
            scene.timestep = std::pow(10.0, random.uniform(-6, 0));
            const std::uint32_t substeps = 1 + random.below(20), iterations = 1 + random.below(4);
            const double size = std::pow(10.0, random.uniform(-3, 3));
            for (std::size_t v = 0; v < 25; ++v)
            {
                const double x = random.uniform(-size, size), y = random.uniform(-size, size);
                scene.bodies[0].start_positions.emplace_back(x, y, random.uniform(-size, size));
            }
            INFO("draw " << draw);
            World world(by_vbd(scene, substeps, iterations), device);
            run(world, 30);
            check_sound(world);
        }
    });
}
