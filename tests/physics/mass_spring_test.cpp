// Mass-spring: golden numbers of the integrators, the two ways to add up forces, convergence to the
// reference.

#include "hard/cases.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/reference_dynamic.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// Methods A3: m = 1 kg, k = 1000 N/m, started 0.1 m off at rest. `rest` is the spring's length.
Scene oscillator(const char* integrator, double h, double rest = 0)
{
    Body body = particles({{0, 0, 0}, {rest + 0.1, 0, 0}});
    body.springs = {{0, 1, rest, 1e-3}};
    body.pins = {hold({0})};
    Scene scene = alone(body);
    scene.timestep = h;
    scene.method.type = MethodKind::mass_spring;
    scene.method.integrator = option_named<Integrator>(integrator);
    scene.method.substeps = 1;
    scene.method.precision = Precision::float64;
    return scene;
}

/// Cloth of 6 x 6 cells that swings from two corners, with hinges: the springs of the thesis, or edges.
Scene swinging(bool network)
{
    Scene scene;
    Body body;
    body.shape.cells = {6, 6};
    body.shape.network = {network, 100, 80, 20};
    body.material.stretch_stiffness = 100;
    body.material.bending_stiffness = 1e-3;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -60;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.duration = 0.3;
    scene.method.type = MethodKind::mass_spring;
    scene.method.stability = StabilityRule::substep;
    return resolve(scene);
}

} // namespace

TEST_CASE("the integrators give the golden numbers of the oscillator (methods A3)")
{
    on_every_device([](const auto& device) {
        struct Golden
        {
            const char* integrator;
            double x, v; // v = 0: not given
        };
        for (const Golden& g : {Golden{"semi_implicit", 0.091644687561376753, -0.93991218696228673},
                                Golden{"verlet", 0.09556098834038626, 0}})
            for (const double rest : {0.0, 1.0})
            {
                INFO(g.integrator << " rest length " << rest);
                World world(oscillator(g.integrator, 1.0 / 120, rest), device);
                run(world, 120);
                const double x = world.positions()[1].x - rest;
                note("A3", *device, g.integrator, std::abs(x - g.x));
                CHECK(std::abs(x - g.x) < (rest > 0 ? 1e-13 : 1e-15));
                if (g.v != 0)
                    CHECK(std::abs(world.velocities()[1].x - g.v) < (rest > 0 ? 1e-11 : 1e-13));
            }
        Scene single = oscillator("semi_implicit", 1.0 / 120);
        single.method.precision = Precision::float32;
        World world(single, device);
        run(world, 120);
        CHECK(world.positions()[1].x == Approx(0.091644687561376753).epsilon(1e-4));
    });
}

TEST_CASE("explicit Euler grows by sqrt(1 + h^2 w^2) a substep, and the plan says so (methods A03)")
{
    on_every_device([](const auto& device) {
        World world(oscillator("explicit", 1.0 / 240), device);
        run(world, 240);
        const double x = world.positions()[1].x, v = world.velocities()[1].x, w2 = 1000;
        const double norm = std::sqrt(x * x + v * v / w2);
        const double exact = 0.1 * std::pow(1 + w2 / (240.0 * 240), 120);
        note("A03", *device, "phase norm / exact - 1", norm / exact - 1);
        CHECK(norm == Approx(exact).epsilon(1e-9));
        check_sound(world, {"energy_growth"});
        const std::string text = world.plan().warnings.at(0).text;
        CHECK(text.find("semi_implicit") != std::string::npos);
    });
}

TEST_CASE("free fall is the true parabola under each integrator")
{
    on_every_device([](const auto& device) {
        for (const char* integrator : {"semi_implicit", "explicit", "verlet"})
        {
            Scene scene = oscillator(integrator, 1.0 / 60);
            scene.gravity = {0, -9.81, 0};
            scene.bodies[0].pins.clear();
            scene.bodies[0].springs = {{0, 1, 0.1, 1e-2}};
            World world(scene, device);
            run(world, 60);
            CHECK(-world.positions()[0].y == Approx(9.81 / 2).epsilon(1e-12));
            CHECK(world.velocities()[1].y == Approx(-9.81).epsilon(1e-12));
            CHECK(world.positions()[1].x == Approx(0.1).epsilon(1e-12));
        }
    });
}

TEST_CASE("node-centric and spring-centric forces move cloth to the same bits")
{
    on_every_device([](const auto& device) {
        for (const double damping : {0.0, 1e-3})
            for (const char* integrator : {"semi_implicit", "verlet"})
            {
                Scene scene = swinging(true);
                scene.bodies[0].material.stretch_damping = damping;
                scene.method.integrator = option_named<Integrator>(integrator);
                scene.method.scheme = ElementScheme::node_centric;
                World node(scene, device);
                scene.method.scheme = ElementScheme::spring_centric;
                World spring(scene, device);
                run(node, 30);
                run(spring, 30);
                CHECK(same_state(node.state(), spring.state()));
                check_sound(spring);
                // What each costs, by formula: hinges and their sum are two passes beside the springs; Verlet
                // forms forces twice; semi-implicit Euler has a pass a step for the velocity at it.
                const std::uint64_t times = integrator[0] == 'v' ? 2 : 1, s = node.plan().substeps;
                CHECK(node.plan().passes.size() == s * (2 + 4 * times) + 2 - times);
                CHECK(spring.plan().passes.size() == s * (2 + 5 * times) + 2 - times);
            }
    });
}

// Gravity's first kick is half, and springs at rest have none: semi-implicit Euler is the leapfrog then.
TEST_CASE("cloth that starts at rest converges to the reference with order 2, by both symplectic integrators")
{
    const auto device = test_device("cpu:serial");
    for (const bool network : {false, true})
    {
        Scene scene = swinging(network);
        scene.method.precision = Precision::float64;
        const PhysicalModel model = make_model(scene);
        const DynamicReference exact = solve_dynamic(model);
        REQUIRE(exact.verified);
        const ErrorWeights weights = error_weights(model);
        for (const char* integrator : {"semi_implicit", "verlet"})
        {
            scene.method.integrator = option_named<Integrator>(integrator);
            double before = 0;
            for (const std::uint32_t substeps : {20u, 40u, 80u})
            {
                scene.method.substeps = substeps;
                World world(scene, device);
                run(world, static_cast<int>(exact.frames.size()) - 1);
                const double error = distance_by_mass(weights, world.positions(), exact.frames.back()) /
                                     distance_by_mass(weights, exact.frames.back(), model.start);
                const double order = std::log2(before / error);
                note("mass_spring", *device, integrator, error);
                if (before > 0)
                    CHECK(std::abs(order - 2) < 0.15);
                before = error;
            }
            CHECK(before < 1e-5);
        }
    }
}

TEST_CASE("a damper takes the energy that it should, along the spring only")
{
    on_every_device([](const auto& device) {
        Scene scene = oscillator("semi_implicit", 1.0 / 60);
        scene.method.substeps = 200;
        scene.bodies[0].material.stretch_damping = 2e-3; // c = 2 N s/m: decay exp(-t)
        World world(scene, device);
        run(world, 60);
        const double w = std::sqrt(1000 - 1.0);
        const double exact = 0.1 * std::exp(-1.0) * (std::cos(w) + std::sin(w) / w);
        note("damper", *device, "error of x after 1 s / amplitude", (world.positions()[1].x - exact) / 0.1);
        CHECK(std::abs(world.positions()[1].x - exact) < 2e-3 * 0.1);

        Scene turning = scene; // a bar that turns about its held end keeps its speed
        turning.bodies[0].start_positions = {{0, 0, 0}, {1, 0, 0}};
        turning.bodies[0].springs = {{0, 1, 1, 1e-5}};
        turning.bodies[0].material.stretch_damping = 1e-3;
        turning.bodies[0].velocity = {0, 1, 0};
        World bar(turning, device);
        run(bar, 60);
        CHECK(glm::length(bar.velocities()[1]) == Approx(1).epsilon(1e-3));
    });
}

TEST_CASE("a hanging chain comes to the length of the sum of its weights")
{
    on_every_device([](const auto& device) {
        Scene scene = test::chain(10, 1000, 0.01);
        scene.method.type = MethodKind::mass_spring;
        scene.method.substeps = 20;
        scene.damping = 8;
        World world(scene, device);
        run(world, steps_for(*device, 600, 300));
        const double extension = -world.positions()[10].y - 1;
        note("mass_spring", *device, "hanging chain, extension / exact - 1", extension / 0.0053955 - 1);
        CHECK(extension == Approx(0.0053955).epsilon(1e-3));
        check_sound(world);
    });
}

TEST_CASE("springs and hinges keep the momentum of a sheet that turns and falls")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(6, 200, 1e-3);
        scene.gravity = {0, -9.81, 0};
        scene.method.type = MethodKind::mass_spring;
        scene.method.substeps = 20;
        scene.bodies[0].material.stretch_damping = 1e-3;
        conformance::Random random(3);
        for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            scene.bodies[0].start_positions.push_back(x + glm::dvec3(0, 0, random.uniform(-0.05, 0.05)));
        for (const char* integrator : {"semi_implicit", "verlet"})
        {
            scene.method.integrator = option_named<Integrator>(integrator);
            World world(scene, device);
            run(world, 60);
            const StepReport report = check_sound(world);
            note("mass_spring", *device, "momentum error", report.momentum_error);
            CHECK(report.momentum_error < 1e-5);
        }
    });
}
