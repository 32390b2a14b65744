// Free motion: falling, momentum, damping, implicit Euler.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("inner forces keep momentum while a sheet falls, turns and swings")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(6, 500, 1e-3);
        scene.gravity = {0, -9.81, 0};
        conformance::Random random(3);
        for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            scene.bodies[0].start_positions.push_back(x + glm::dvec3(0, 0, random.uniform(-0.05, 0.05)));
        for (const std::uint32_t iterations : {1u, 4u})
        {
            scene.method.iterations = iterations;
            World world(scene, device);
            run(world,
                60); // what remains is gravity's rounding: at most half a unit of the velocity a substep
            const StepReport report = check_sound(world);
            note("physics", *device, "momentum error, falling sheet", report.momentum_error);
            CHECK(report.momentum_error < 1e-5);
        }
    });
}

TEST_CASE("without gravity a sheet keeps its momentum and its place of mass")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(5, 500, 1e-3);
        for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            scene.bodies[0].start_positions.push_back(glm::dvec3(1.2 * x.x, 0.9 * x.y, 0.3 * x.x * x.y));
        World world(scene, device);
        const PhysicalModel model = make_model(scene);
        const auto centre = [&] {
            glm::dvec3 sum(0);
            double mass = 0;
            const auto x = world.positions();
            for (std::size_t v = 0; v < x.size(); ++v)
            {
                sum += model.mass[v] * x[v];
                mass += model.mass[v];
            }
            return sum / mass;
        };
        const glm::dvec3 before = centre();
        run(world, 120);
        note("physics", *device, "drift of the centre of mass, m", glm::distance(centre(), before));
        CHECK(glm::distance(centre(), before) < 1e-6);
        CHECK(check_sound(world).kinetic_energy > 0);
    });
}

TEST_CASE("damping lets velocities decay as exp(-c t), whatever the substeps")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t substeps : {1u, 7u})
        {
            Body body = particles({{0, 0, 0}});
            body.velocity = {3, -1, 2};
            Scene scene = alone(body);
            scene.damping = 2;
            scene.method.substeps = substeps;
            World world(scene, device);
            run(world, 60);
            const double left = glm::length(world.velocities()[0]) / (std::sqrt(14.0) * std::exp(-2.0));
            note("physics", *device, "damped speed / exp(-c t)", left);
            CHECK(left == Approx(1).epsilon(2e-5));
        }
    });
}

TEST_CASE("damping does not touch where a weight hangs")
{
    // Damping after gravity would scale gravity by exp(-c h) (methods 5.1).
    on_every_device([](const auto& device) {
        Scene scene = test::chain(1, 100, 0.1);
        scene.damping = 20;
        scene.method.substeps = 2;
        World world(scene, device);
        run(world, 600);
        CHECK(-world.positions()[1].y - 1 == Approx(0.1 * 9.81 / 100).epsilon(1e-4));
    });
}

TEST_CASE("one spring with one iteration is implicit Euler (methods A3)")
{
    // m = 1, k = 1000, h = 1/120, 120 steps from x = 0.1 at rest; both ends of the spring on one line.
    constexpr double x_exact = 0.001565729438841746, v_exact = 0.026798328097130026;
    on_every_device([&](const auto& device) {
        for (const char* precision : {"float", "double"})
        {
            Body body = particles({{0, 0, 0}, {1.1, 0, 0}});
            body.springs = {{0, 1, 1, 1e-3}};
            body.pins = {hold({0})};
            Scene scene = alone(body);
            scene.timestep = 1.0 / 120;
            scene.method.substeps = 1;
            scene.method.precision = option_named<Precision>(precision);
            World world(scene, device);
            run(world, 120);
            const double dx = std::abs(world.positions()[1].x - 1 - x_exact);
            const double dv = std::abs(world.velocities()[1].x - v_exact);
            note("physics", *device, (std::string("implicit Euler, x, ") + precision).c_str(), dx);
            const bool exact = precision[0] == 'd';
            CHECK(dx < (exact ? 1e-14 : 1e-6)); // the values of the reference have 16 digits
            CHECK(dv < (exact ? 1e-12 : 3e-5));
        }
    });
}

TEST_CASE("many substeps do not lose to rounding: 256 in float are as right as in double")
{
    // Methods finding 4: plain float is 70 times worse at 256 substeps, also 100 m from the origin.
    on_every_device([](const auto& device) {
        for (const double away : {0.0, 100.0})
        {
            Scene scene = test::chain(8, 2000, 0.01);
            scene.damping = 10;
            scene.method.substeps = 256;
            for (glm::dvec3& x : scene.bodies[0].mesh.positions)
                x += glm::dvec3(away, away, 0);
            const int steps = steps_for(*device, 120, 60);
            World world(scene, device);
            run(world, steps);
            scene.method.precision = Precision::float64;
            World exact(scene, test_device("cpu:serial"));
            run(exact, steps);
            const double extension = 0.01 * 9.81 * 36 / 2000;
            const double error = largest_distance(world.positions(), exact.positions()) / extension;
            note("physics", *device,
                 away > 0 ? "256 substeps, float against double, at 100 m"
                          : "256 substeps, float against double",
                 error);
            CHECK(error < 1e-3);
        }
    });
}

TEST_CASE("no step makes XPBD infinite: springs of any stiffness, any step, any start")
{
    on_every_device([](const auto& device) {
        conformance::Random random(5);
        for (int draw = 0; draw < 12; ++draw)
        {
            Scene scene =
                free_cloth(4, std::pow(10.0, random.uniform(-3, 14)), std::pow(10.0, random.uniform(-8, 4)));
            scene.gravity = {0, -random.uniform(0, 1000), 0};
            scene.timestep = std::pow(10.0, random.uniform(-6, 0));
            scene.method.substeps = 1 + random.below(20);
            scene.method.iterations = 1 + random.below(4);
            const double size = std::pow(10.0, random.uniform(-3, 3));
            for (std::size_t v = 0; v < 25; ++v)
            {
                const double x = random.uniform(-size, size), y = random.uniform(-size, size);
                scene.bodies[0].start_positions.emplace_back(x, y, random.uniform(-size, size));
            }
            INFO("draw " << draw);
            World world(scene, device);
            run(world, 30);
            check_sound(world);
        }
    });
}

TEST_CASE("a spring with a damper and one iteration is implicit Euler with that damper")
{
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {1.1, 0, 0}}, 2);
        body.springs = {{0, 1, 1, 1e-3}};
        body.pins = {hold({0})};
        body.material.stretch_damping = 0.004; // 4 N s/m
        Scene scene = alone(body);
        scene.method.substeps = 4;
        for (const char* precision : {"float", "double"})
        {
            scene.method.precision = option_named<Precision>(precision);
            World world(scene, device);
            run(world, 30);
            double x = 0.1, v = 0;
            for (int i = 0; i < 120; ++i)
            {
                const double h = 1.0 / 240;
                v = (2 * v - h * 1000 * x) / (2 + h * 4 + h * h * 1000);
                x += h * v;
            }
            const double apart = std::abs(world.positions()[1].x - 1 - x);
            note("physics", *device, "damped spring against implicit Euler, m", apart);
            CHECK(apart < (precision == std::string("float") ? 1e-5 : 1e-12));
            CHECK(std::abs(x) > 1e-3);
            check_sound(world);
        }
    });
}

TEST_CASE("springs with dampers rest as those without, and their plan is another only where they are")
{
    Scene scene = test::chain(5, 1000, 0.1);
    const Plan without = make_plan(scene);
    scene.bodies[0].material.stretch_damping = 0.01;
    const Plan with = make_plan(scene);
    CHECK(with.passes.size() == without.passes.size());
    CHECK(with.bytes_allocated() == without.bytes_allocated() + 5 * 4);
    on_every_device([&](const auto& device) {
        // A damper makes each correction smaller, so few sweeps leave more of the weight's step undone.
        double before = 1;
        for (const std::uint32_t iterations : {1u, 4u, 16u})
        {
            Scene damped = scene;
            damped.damping = 5;
            damped.method.iterations = iterations;
            damped.method.substeps = 5;
            Scene plain = damped;
            plain.bodies[0].material.stretch_damping = 0;
            World a(damped, device), b(plain, device);
            run(a, 400);
            run(b, 400);
            const double apart = largest_distance(a.positions(), b.positions());
            note("physics", *device, "hanging chain with dampers against without, m", apart);
            CHECK(apart < 0.5 * before);
            before = apart;
            check_sound(a);
        }
        CHECK(before < 1e-5);
    });
}
