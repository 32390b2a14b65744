// Stiffnesses, masses and time steps at their ends under implicit Euler (methods 2.A).

#include "hard/implicit.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("A02, implicit Euler: beyond the explicit limit a spring only loses energy [hard]")
{
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {1.1, 0, 0}});
        body.springs = {{0, 1, 1.0, 1e-3}};
        body.pins = {hold({0})};
        Scene scene = implicit(alone(body));
        for (const double h : {1.01 * 0.0632456, 1.0})
        {
            scene.timestep = h;
            World world(scene, device);
            const double first = energy(world);
            double before = first;
            for (int i = 0; i < 50; ++i)
            {
                world.step();
                CHECK(energy(world) <= before * (1 + 1e-6) + 1e-12 * first); // float's rounding at rest
                before = energy(world);
            }
            check_sound(world);
        }
    });
}

TEST_CASE("A04, implicit Euler: cloth of 1e8 N/m hung by an edge does not stretch and does not jitter [hard]")
{
    on_every_device([](const auto& device) {
        const bool whole = device->info().executor == "cpu:serial";
        for (const bool falls : {false, true}) // from the vertical, and from the horizontal
        {
            Scene scene;
            Body body;
            body.shape.cells = {10, 10};
            body.material.stretch_stiffness = 1e8;
            body.transform.rotate_axis = {1, 0, 0};
            body.transform.rotate_degrees = falls ? -90 : 0;
            Pin pin;
            pin.edges = {"top"};
            body.pins = {pin};
            scene.bodies = {body};
            scene.damping = 2;
            World world(implicit(resolve(scene), 10), device);
            double stretch = 0;
            for (int i = 0; i < (whole ? 300 : 5); ++i)
            {
                world.step();
                stretch = std::max(stretch, measure(world).max_stretch);
            }
            const StepReport report = check_solved(world);
            const double speed = report.max_speed / std::sqrt(9.81 * std::sqrt(2.0));
            note("A04", *device, falls ? "largest stretch, fallen" : "largest stretch, hung", stretch);
            note("A04", *device, falls ? "speed / sqrt(g D), fallen" : "speed / sqrt(g D), hung", speed);
            note("A04", *device, falls ? "share of solves at their limit, fallen" : "the same, hung",
                 double(report.solver.limited) / double(report.solver.solves));
            CHECK(stretch < 0.05);
            if (!falls) // solves cut short make the fall slow, see docs/methods/implicit_euler.md
                CHECK(speed < 1e-2);
        }
    });
}

TEST_CASE("A05, implicit Euler: alternating springs of 1e3 and 1e6 N/m carry one tension [hard]")
{
    on_every_device([](const auto& device) {
        if (!device->limits().float64)
            return;
        std::vector<glm::dvec3> places;
        for (int i = 0; i <= 8; ++i)
            places.emplace_back(0.0, -4.0 * i, 0.0);
        Body body = particles(places, 1e-6);
        body.vertex_masses.back() = 10;
        for (std::uint32_t i = 0; i < 8; ++i)
            body.springs.push_back({i, i + 1, 4.0, i % 2 == 0 ? 1e-3 : 1e-6});
        body.pins = {hold({0})};
        Scene scene = in_double(implicit(alone(body)));
        scene.gravity = {0, -9.81, 0};
        scene.damping = 5;
        World world(scene, device);
        run(world, 600);
        const auto x = world.positions();
        double least = kInfinity, most = 0;
        for (std::uint32_t i = 0; i < 8; ++i)
        {
            const double tension = (glm::distance(x[i], x[i + 1]) - 4) * (i % 2 == 0 ? 1e3 : 1e6);
            least = std::min(least, tension);
            most = std::max(most, tension);
        }
        note("A05", *device, "tension, largest / smallest - 1", most / least - 1);
        CHECK(most / least < 1.01);
        CHECK(most == Approx(98.1).epsilon(0.01));
        check_solved(world);
    });
}

TEST_CASE("A09, implicit Euler: a twisted strip from 2 ms to 1 s a step, and 2 s refused [hard]")
{
    on_every_device([](const auto& device) {
        const auto strip = [](double h) {
            Scene scene;
            Body body;
            body.shape.cells = {12, 2};
            body.shape.size = {0.6, 0.1};
            body.material.stretch_stiffness = 1e4;
            body.material.bending_stiffness = 1e-2;
            Pin pin;
            pin.edges = {"left", "right"};
            body.pins = {pin};
            scene.bodies = {body};
            scene = implicit(resolve(scene), 1, 3);
            scene.method.line_search = 4;
            scene.timestep = h;
            scene.gravity = {0, 0, 0};
            scene.damping = 5;
            scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
            for (glm::dvec3& x : scene.bodies[0].start_positions)
            {
                const double turn = 1.5 * (x.x + 0.3) / 0.6; // rad
                x = {x.x, x.y * std::cos(turn), x.y * std::sin(turn)};
            }
            return in_double(scene);
        };
        if (!device->limits().float64)
            return;
        std::vector<glm::dvec3> fine;
        for (const double h : {0.002, 0.02, 0.2, 1.0})
        {
            if (h < 0.02 && device->info().executor != "cpu:serial")
                continue;
            World world(strip(h), device);
            double most = energy(world);
            const double start = most;
            for (int i = 0; i < std::max(60, int(6 / h)); ++i)
            {
                world.step();
                most = std::max(most, energy(world));
            }
            const StepReport report = check_solved(world);
            note("A09", *device, "energy at most / at the start", most / start);
            CHECK(most <= start * (1 + 1e-6));
            CHECK(report.max_speed < 1e-3);
            if (fine.empty())
                fine = world.positions();
            note("A09", *device, "shape at rest against the smallest step, m",
                 largest_distance(fine, world.positions()));
            CHECK(largest_distance(fine, world.positions()) < 0.05 * 0.1);
        }
        CHECK(refusal_of([&] { World refused(strip(2), device); }) == "bad_timestep");
    });
}

TEST_CASE("A13, implicit Euler: what is all held stays bit by bit and costs no solver pass [hard]")
{
    Scene scene = implicit(test::hanging(4));
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    scene.bodies[0].start_positions[7] += glm::dvec3(0.1, 0.2, 0.3);
    scene.bodies[0].material.bending_stiffness = 1e-3;
    for (std::uint32_t v = 0; v < 25; ++v)
        scene.bodies[0].pins[0].vertices.push_back(v);
    on_every_device([&](const auto& device) {
        World world(scene, device);
        CHECK(world.plan().solvers.empty());
        CHECK(world.plan().passes.size() == 2 * world.plan().substeps);
        const WorldState before = world.state();
        run(world, 50);
        CHECK(same_state(world.state(), before));
        check_sound(world, {"conflict"});
    });
}

TEST_CASE("A15, implicit Euler: no stiffness leaves a free particle, and any mass stays finite [hard]")
{
    on_every_device([](const auto& device) {
        Scene soft = implicit(test::hanging(3));
        soft.bodies[0].material.stretch_stiffness = 0;
        soft.bodies[0].velocity = {0.3, 1, -0.2};
        WorldOptions only;
        only.plan.available_effects = {"motion"};
        World none(soft, device, only), zero(soft, device);
        run(none, 30);
        run(zero, 30);
        CHECK(same_state(none.state(), zero.state()));
        for (const double heavy : {1.0, 1e12})
            for (const double light : {1.0, 1e-12})
            {
                Body body = particles({{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}});
                body.vertex_masses = {heavy, light, heavy};
                body.springs = {{0, 1, 0.9, 1e-3}, {1, 2, 1.2, 1e-3}};
                body.velocity = {1, 2, 0};
                World world(implicit(alone(body)), device);
                run(world, 60);
                CHECK(check_solved(world).momentum_error < 1e-5);
            }
    });
}

TEST_CASE("A16, implicit Euler: stiff cloth that hung in peace falls freely once let go [hard]")
{
    on_every_device([](const auto& device) {
        Scene held = implicit(test::hanging(4));
        held.bodies[0].material.stretch_stiffness = 1e6;
        held.damping = 2;
        World first(held, device);
        run(first, steps_for(*device, 120, 20));
        Scene loose = held;
        loose.damping = 0;
        loose.bodies[0].pins.clear();
        loose.bodies[0].start_positions = first.positions();
        World world(loose, device);
        const auto centre = [&](const World& w) {
            const PhysicalModel model = make_model(loose);
            double sum = 0, mass = 0;
            const auto x = w.positions();
            for (std::size_t v = 0; v < x.size(); ++v)
            {
                sum += model.mass[v] * x[v].y;
                mass += model.mass[v];
            }
            return sum / mass;
        };
        const double before = centre(world);
        run(world, 60);
        note("A16", *device, "fall in 1 s / 4.905 m - 1", (before - centre(world)) / 4.905 - 1);
        CHECK((before - centre(world)) / 4.905 == Approx(1).margin(1e-4));
        CHECK(check_solved(world).momentum_error < 1e-4);
    });
}
