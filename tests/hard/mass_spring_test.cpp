// Mass-spring: steps, stiffness, masses (methods 2.A).

#include "hard/mass_spring_cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE(
    "A01, A02: just inside the explicit limit springs swing for ever, just outside they are refused [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* precision : {"float", "double"})
            for (const char* integrator : {"semi_implicit", "verlet"})
            {
                Scene scene = oscillator(0.99 * kLimit, integrator);
                scene.method.precision = option_named<Precision>(precision);
                World world(scene, device);
                const double first = kept_by_euler(world);
                double largest = 0, drift = 0;
                for (int i = 0; i < steps_for(*device, 20000, 500); ++i)
                {
                    world.step();
                    largest = std::max(largest, std::abs(world.positions()[1].x));
                    drift = std::max(drift, std::abs(kept_by_euler(world) / first - 1));
                }
                CHECK(largest <= 0.7096);
                if (integrator[0] == 's')
                {
                    note("A01", *device, precision, drift);
                    CHECK(drift < (precision[0] == 'd' ? 1e-11 : 1e-3));
                    continue; // it swings 7 times as far as it was let go from, which is not sound
                }
                check_sound(world);
            }
        for (const char* integrator : {"semi_implicit", "verlet", "explicit"})
        {
            Scene outside = oscillator(1.01 * kLimit, integrator);
            outside.method.stability = StabilityRule::refuse;
            std::string text;
            CHECK(refusal_of([&] { World refused(outside, device); }, &text) == "unstable_timestep");
            CHECK(text.find("2 substeps") != std::string::npos);
            outside.method.stability = StabilityRule::substep;
            World cut(outside, device);
            CHECK(cut.plan().substeps == 2);
            CHECK(refusal_of([&] { cut.set_timestep(0.1); }) == "unstable_timestep");
            CHECK(cut.plan().timestep == outside.timestep);
            cut.set_timestep(0.08);
        }
    });
}

TEST_CASE("A02: beyond the limit at one's own risk a run ends as diverged or non_finite, never in NaN [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* integrator : {"semi_implicit", "verlet", "explicit"})
        {
            World world(oscillator(1.01 * kLimit, integrator), device);
            int steps = 0;
            while (std::abs(world.positions()[1].x) < 1e3 && steps < 100)
            {
                world.step();
                ++steps;
            }
            CHECK(steps < 100);
            run(world, 3000);
            const std::string status(to_string(measure(world).status));
            CHECK((status == "diverged" || status == "non_finite"));
            CHECK(finite(world.positions()));
            CHECK(finite(world.velocities()));
        }
        Scene still = by_springs(free_cloth(6, 1000, 1e-4)); // rounding is enough for explicit Euler
        still.method.integrator = Integrator::explicit_euler;
        World growing(still, device);
        run(growing, steps_for(*device, 1000, 10));
        CHECK(finite(growing.positions()));
        CHECK(finite(growing.velocities()));
        Scene cloth = by_springs(test::everything(6), 1);
        cloth.bodies[0].material.stretch_stiffness = 1e6;
        cloth.method.stability = StabilityRule::ignore;
        World world(cloth, device);
        run(world, 200);
        const std::string status(to_string(measure(world).status));
        CHECK((status == "diverged" || status == "non_finite" || status == "completed"));
        CHECK(finite(world.positions()));
        CHECK(finite(world.velocities()));
    });
}

TEST_CASE("A04: stiff cloth is refused with the number of substeps that it would take [hard]")
{
    Scene scene = by_springs(test::hanging(8), 10);
    scene.bodies[0].material.stretch_stiffness = 1e8;
    std::string text;
    const auto device = test_device("cpu:serial");
    CHECK(refusal_of([&] { World refused(scene, device); }, &text) == "unstable_timestep");
    CHECK(text.find("substeps") != std::string::npos);
    scene.method.stability = StabilityRule::substep; // more than 1000 of them
    CHECK(refusal_of([&] { World refused(scene, device); }) == "unstable_timestep");
    scene.bodies[0].material.stretch_stiffness = kInfinity;
    CHECK(refusal_of([&] { World refused(scene, device); }, &text) == "unsupported");
    CHECK(text.find("xpbd") != std::string::npos);
}

TEST_CASE("A10: no time step, no change, under springs too [hard]")
{
    on_every_device([](const auto& device) {
        World world(by_springs(test::hanging(3)), device);
        run(world, 3);
        const WorldState before = world.state();
        for (const double bad : {0.0, -1.0 / 60, kNaN, 1e30})
            CHECK(refusal_of([&] { world.set_timestep(bad); }) == "bad_timestep");
        CHECK(same_state(world.state(), before));
    });
}

TEST_CASE("A12: a step that changes on the way makes no jump of the velocity [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* integrator : {"semi_implicit", "verlet"})
        {
            Scene scene = by_springs(test::chain(1, 1000, 1), 10);
            scene.bodies[0].start_positions = {{0, 0, 0}, {0.5, -std::sqrt(0.75), 0}};
            scene.method.integrator = option_named<Integrator>(integrator);
            World world(scene, device);
            double jump = 0;
            for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 30, 1.0 / 60})
            {
                world.set_timestep(h);
                for (int i = 0; i < 30; ++i)
                {
                    const glm::dvec3 before = world.velocities()[1];
                    world.step();
                    jump = std::max(jump, glm::length(world.velocities()[1] - before) / (9.81 * h));
                }
            }
            note("A12", *device, "velocity jump / (g h)", jump);
            CHECK(jump <
                  4); // the tension of a swing adds up to twice the weight, the spring's own swing as much
            check_sound(world);
        }
    });
}

TEST_CASE("A13: cloth that is all held stays bit by bit under springs, without a pass of theirs [hard]")
{
    Scene scene = by_springs(test::hanging(4));
    scene.bodies[0].material.bending_stiffness = 1e-5;
    for (std::uint32_t v = 0; v < 25; ++v)
        scene.bodies[0].pins[0].vertices.push_back(v);
    on_every_device([&](const auto& device) {
        World world(scene, device);
        CHECK(world.plan().passes.size() == 2 * world.plan().substeps + 1); // guess, update; coast
        const WorldState before = world.state();
        run(world, 50);
        CHECK(same_state(world.state(), before));
        check_sound(world);
    });
}

TEST_CASE(
    "A15: springs of no stiffness leave free particles; masses of 1e12 and 1e-12 kg keep momentum [hard]")
{
    on_every_device([](const auto& device) {
        Scene soft = by_springs(test::hanging(4));
        soft.bodies[0].material.stretch_stiffness = 0;
        soft.bodies[0].velocity = {0.3, 1, -0.2};
        WorldOptions only;
        only.plan.available_effects = {"motion"};
        World none(soft, device, only), zero(soft, device);
        run(none, 60);
        run(zero, 60);
        CHECK(same_state(none.state(), zero.state()));
        for (const double heavy : {1.0, 1e12})
            for (const double light : {1.0, 1e-12})
            {
                Body body = particles({{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}});
                body.vertex_masses = {heavy, light, heavy};
                body.springs = {{0, 1, 0.9, 1e9}, {1, 2, 1.2, 1e9}}; // k such that the light one is stable
                body.velocity = {1, 2, 0};
                World world(by_springs(alone(body), 20), device);
                run(world, 120);
                CHECK(check_sound(world).momentum_error < 1e-5);
            }
    });
}

TEST_CASE("A16: a stiff sheet that is let go falls at once [hard]")
{
    on_every_device([](const auto& device) {
        Scene held = by_springs(test::hanging(4), 100);
        held.damping = 3;
        World rest(held, device);
        run(rest, 30);
        Scene free = held;
        free.damping = 0;
        free.bodies[0].pins.clear();
        free.bodies[0].start_positions = rest.positions();
        World world(free, device);
        const auto centre = [&] {
            const PhysicalModel model = make_model(free);
            double sum = 0, mass = 0;
            const auto x = world.positions();
            for (std::size_t v = 0; v < x.size(); ++v)
            {
                sum += model.mass[v] * x[v].y;
                mass += model.mass[v];
            }
            return sum / mass;
        };
        const double before = centre();
        run(world, 60);
        CHECK(before - centre() == Approx(9.81 / 2).epsilon(1e-4));
    });
}
