// Degenerate shapes, odd topologies, shocks and reproducibility under implicit Euler (methods 2.B, C, D, G).

#include "hard/implicit.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("B01, B02, B03, implicit Euler: springs without length, direction or both [hard]")
{
    on_every_device([](const auto& device) {
        Body loop = particles({{0, 0, 0}, {0.1, 0, 0}});
        loop.springs = {{0, 1, 0.0, 1e-3}};
        loop.pins = {hold({0})};
        Scene scene = implicit(alone(loop), 1, 2);
        scene.damping = 2;
        World closing(scene, device);
        run(closing, 300);
        CHECK(glm::length(closing.positions()[1]) < 1e-6);
        check_solved(closing);
        for (const double apart : {0.0, 1e-20, 1e-30})
        {
            Body pair = particles({{0, 0, 0}, {apart, 0, 0}, {3, 0, 0}, {4.1, 0, 0}});
            pair.springs = {{0, 1, 0.1, 1e-3}, {2, 3, 1.0, 1e-3}};
            Body alone_pair = particles({{3, 0, 0}, {4.1, 0, 0}});
            alone_pair.springs = {{0, 1, 1.0, 1e-3}};
            World both(implicit(alone(pair)), device), one(implicit(alone(alone_pair)), device);
            run(both, 20);
            run(one, 20);
            CHECK(glm::distance(both.positions()[2], one.positions()[0]) < 1e-5);
            check_solved(both, apart > 0 && measure(both).warnings.count("degenerate") == 0
                                   ? Words{}
                                   : Words{"degenerate"});
        }
    });
}

TEST_CASE("B16, implicit Euler: cloth at rest without gravity stays at rest [hard]")
{
    on_every_device([](const auto& device) {
        World world(implicit(free_cloth(5)), device);
        const auto before = world.positions();
        run(world, steps_for(*device, 1000, 100));
        note("B16", *device, "e_L", largest_distance(before, world.positions()) / 1.414);
        CHECK(largest_distance(before, world.positions()) < 1e-6 * 1.414);
        check_solved(world);
    });
}

TEST_CASE("B17, implicit Euler: a hinge without an edge or an area is skipped and counted [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = implicit(free_cloth(3));
        scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
        scene.bodies[0].start_positions[5] = scene.bodies[0].start_positions[6];
        World world(scene, device);
        world.step();
        CHECK(measure(world).warnings.at("degenerate") > 0);
        run(world, 120);
        CHECK(finite(world.positions()));
        CHECK(to_string(measure(world).status) == "completed");
    });
}

TEST_CASE("B18, implicit Euler: a net 10 km from the origin is as right as at the origin [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = implicit(test::hanging(4), 4);
        scene.damping = 1;
        Scene far = scene;
        for (glm::dvec3& x : far.bodies[0].mesh.positions)
            x += glm::dvec3(1e4, 0, 0);
        World near(scene, device), away(far, device);
        run(near, steps_for(*device, 60, 6));
        run(away, steps_for(*device, 60, 6));
        const auto a = near.positions(), b = away.positions();
        double worst = 0;
        for (std::size_t v = 0; v < a.size(); ++v)
            worst = std::max(worst, glm::distance(a[v] + glm::dvec3(1e4, 0, 0), b[v]));
        note("B18", *device, "difference, m", worst);
        CHECK(worst < 0.01);
        Words words;
        for (const PlanWarning& warning : away.plan().warnings)
            words.insert(warning.word);
        check_solved(away, words);
    });
}

TEST_CASE("C02, C03, implicit Euler: a star of 3000 springs on one vertex [hard]")
{
    on_every_device([](const auto& device) {
        std::vector<glm::dvec3> places = {{0, 0, 0}};
        for (int i = 0; i < 3000; ++i)
            places.emplace_back(1.05 * std::cos(i * 0.7), 1.05 * std::sin(i * 0.7), 0.1 * (i % 7));
        Body body = particles(places, 0.01);
        for (std::uint32_t v = 1; v < places.size(); ++v)
            body.springs.push_back({0, v, 1.0, 1e-2});
        World world(implicit(alone(body)), device);
        run(world, steps_for(*device, 30, 3));
        check_solved(world);
        glm::dvec3 momentum(0);
        for (const glm::dvec3& v : world.velocities())
            momentum += 0.01 * v;
        CHECK(measure(world).max_speed > 0.01);
        CHECK(glm::length(momentum) / 30.01 < 1e-5); // m/s, of the centre of mass
    });
}

TEST_CASE("C05, C06, C08, implicit Euler: loose particles, doubled springs, nothing at all [hard]")
{
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {1.1, 0, 0}, {5, 2, 0}});
        body.springs = {{0, 1, 1.0, 1e-3}};
        Scene scene = implicit(alone(body));
        scene.gravity = {0, -9.81, 0};
        Scene twice = scene, stiff = scene;
        twice.bodies[0].springs.push_back({0, 1, 1.0, 1e-3});
        stiff.bodies[0].springs[0].compliance = 5e-4;
        World one(scene, device), two(twice, device), half(stiff, device);
        for (World* world : {&one, &two, &half})
            run(*world, 60);
        CHECK(one.positions()[2].y == Approx(2 - 4.905).epsilon(1e-6));
        CHECK(largest_distance(two.positions(), half.positions()) < 1e-4);
        check_solved(two);
        World empty(implicit(Scene{}), device);
        empty.step();
        CHECK(empty.plan().passes.empty());
    });
}

TEST_CASE("G03, implicit Euler: cloth survives 1e6 N on one vertex for one frame [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = implicit(test::hanging(6), 2);
        scene.external_forces = true;
        scene.damping = 1;
        World world(scene, device);
        run(world, 5);
        world.set_force(24, {0, 0, 1e6});
        world.step();
        world.set_force(24, {0, 0, 0});
        run(world, steps_for(*device, 900, 200));
        const StepReport report = check_solved(world);
        note("G03", *device, "stretch at the end", report.max_stretch);
        CHECK(report.max_stretch < (device->info().executor == "cpu:serial" ? 0.02 : 1.0));
    });
}

TEST_CASE("G04, implicit Euler: gravity of 1e4 turned every frame gives no more than its kicks [hard]")
{
    // Between two steps a velocity is kicked by half of each step's gravity, at first by half of the first
    // one's: turned every frame, gravity kicks once and never again. The displacements of the steps, which
    // are what the method descends by, then have no energy to gain.
    on_every_device([](const auto& device) {
        Scene scene = in_double(implicit(test::hanging(5)));
        if (!device->limits().float64)
            return;
        scene.method.substeps = 1;
        World world(scene, device);
        const PhysicalModel model = make_model(scene);
        glm::dvec3 gravity(0, -1e4, 0);
        std::vector<glm::dvec3> before = world.positions();
        const auto inner = [&] {
            const std::vector<glm::dvec3> x = world.positions();
            double sum = elastic_energy(model, x);
            for (std::size_t v = 0; v < x.size(); ++v)
                sum += 0.5 * model.mass[v] * glm::dot(x[v] - before[v], x[v] - before[v]) /
                       (scene.timestep * scene.timestep);
            before = x;
            return sum;
        };
        double bound = 0; // J: of the first kick
        for (std::size_t v = 0; v < model.mass.size(); ++v)
            bound += model.pinned[v] ? 0 : 0.5 * model.mass[v] * std::pow(0.5e4 * scene.timestep, 2);
        for (int i = 0; i < 40; ++i)
        {
            world.set_gravity(gravity);
            world.step();
            const double now = inner();
            CHECK(now <= bound * (1 + 1e-6));
            bound = now;
            gravity = -gravity;
        }
        check_solved(world);
    });
}

TEST_CASE("G06, G09, implicit Euler: runs repeat, and go on from a saved state, in the same bits [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = implicit(test::everything(5), 2, 2);
        scene.method.line_search = 2;
        World once(scene, device), twice(scene, device), rest(scene, device);
        run(once, 12);
        run(twice, 6);
        rest.restore(twice.state());
        run(rest, 6);
        run(twice, 6);
        CHECK(same_state(once.state(), twice.state()));
        CHECK(same_state(once.state(), rest.state()));
        check_solved(once, measure(once).warnings.count("conflict") > 0 ? Words{"conflict"} : Words{});
    });
}

TEST_CASE("implicit Euler: software executors agree in every bit [hard]")
{
    Scene scene = implicit(test::everything(6), 2, 2);
    scene.method.line_search = 2;
    for (const char* linear_operator : {"assembled", "matrix_free"})
    {
        scene.method.linear_operator = option_named<LinearOperator>(linear_operator);
        World serial(scene, test_device("cpu:serial"));
        run(serial, 6);
        on_every_device([&](const auto& device) {
            if (device->info().hardware_gpu)
                return;
            World world(scene, device);
            run(world, 6);
            CHECK(same_state(world.state(), serial.state()));
        });
    }
}

TEST_CASE("D07, implicit Euler: compressed springs never make the matrix indefinite [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = implicit(free_cloth(6, 1e5, 1e-2));
        scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
        for (glm::dvec3& x : scene.bodies[0].start_positions)
            x = {0.3 * x.x, 0.4 * x.y, 0.05 * std::sin(9 * x.x)};
        World world(scene, device);
        for (int i = 0; i < 30; ++i)
        {
            world.step();
            const Status last = world.solver_report().last;
            CHECK(last != Status::indefinite_matrix);
            CHECK(last != Status::indefinite_preconditioner);
            CHECK(last != Status::non_finite);
        }
        check_solved(world);
    });
}
