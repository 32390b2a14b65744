// Implicit Euler: golden numbers, agreement of its two operators, laws, and references that share no code.

#include "hard/cases.hpp"
#include "taut/report/errors.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/report/scene_budget.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// One Newton step a substep, one substep a step, in double, solved to rounding.
Scene implicit(Scene scene)
{
    scene.method = {};
    scene.method.type = MethodKind::implicit_euler;
    scene.method.precision = Precision::float64;
    scene.method.substeps = scene.method.iterations = 1;
    scene.method.linear_tolerance = 1e-13;
    scene.method.linear_iterations = 400;
    return scene;
}

/// A mass of 1 kg on a spring of 1000 N/m and length 1 along x, 0.1 m too far.
Scene oscillator()
{
    Body body = particles({{0, 0, 0}, {1.1, 0, 0}});
    body.springs = {{0, 1, 1.0, 1e-3}};
    body.pins = {hold({0})};
    Scene scene = implicit(alone(body));
    scene.timestep = 1.0 / 120;
    return scene;
}

/// Methods A4: n x n vertices on a square metre, structural springs of 1000 N/m, 5 % stretched, border held.
Scene clamped_net(std::uint32_t n, double density)
{
    const double spacing = 1.0 / (n - 1);
    std::vector<glm::dvec3> places;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            places.emplace_back(i * spacing, j * spacing, 0);
    Body body = particles(places, density * spacing * spacing);
    std::vector<std::uint32_t> border;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
        {
            const std::uint32_t v = j * n + i;
            if (i == 0 || j == 0 || i + 1 == n || j + 1 == n)
                border.push_back(v);
            if (i + 1 < n)
                body.springs.push_back({v, v + 1, spacing / 1.05, 1e-3});
            if (j + 1 < n)
                body.springs.push_back({v, v + n, spacing / 1.05, 1e-3});
        }
    body.pins = {hold(border)};
    Scene scene = implicit(alone(body));
    scene.gravity = {0, 0, -9.81};
    return scene;
}

/// Bent, stretched, sheared, damped cloth that nothing holds.
Scene crumpled(std::uint32_t n, std::string linear_operator)
{
    Scene scene = implicit(free_cloth(n, 300, 1e-2));
    scene.method.linear_operator = option_named<LinearOperator>(std::move(linear_operator));
    scene.bodies[0].material.stretch_damping = 1e-3;
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x = {1.1 * x.x + 0.1 * x.y, x.y, 0.2 * std::sin(4 * x.x) + 0.1 * x.y * x.y};
    return scene;
}

} // namespace

TEST_CASE("one Newton step on a spring along its line is backward Euler to the last digits")
{
    on_every_device([](const auto& device) {
        if (!device->limits().float64)
            return;
        for (const char* linear_operator : {"assembled", "matrix_free"})
        {
            Scene scene = oscillator();
            scene.method.linear_operator = option_named<LinearOperator>(linear_operator);
            World world(scene, device);
            run(world, 120);
            const double x = world.positions()[1].x - 1, v = world.velocities()[1].x;
            note("A3", *device, "x - golden", x - 0.001565729438841746);
            CHECK(std::abs(x - 0.001565729438841746) < 1e-14);
            CHECK(std::abs(v - 0.026798328097130026) < 1e-13);
            check_sound(world);
        }
    });
}

TEST_CASE("a damper takes from a spring what backward Euler says")
{
    // (1 + h c + h^2 k) x' = (1 + h c) x + h v along the line of the spring.
    Scene scene = oscillator();
    scene.bodies[0].material.stretch_damping = 1e-3; // c = 1 N s/m
    World world(scene, test_device("cpu:serial"));
    const double h = 1.0 / 120, c = 1, k = 1000;
    double x = 0.1, v = 0;
    for (int i = 0; i < 60; ++i)
    {
        world.step();
        const double next = ((1 + h * c) * x + h * v) / (1 + h * c + h * h * k);
        v = (next - x) / h;
        x = next;
    }
    CHECK(std::abs(world.positions()[1].x - 1 - x) < 1e-13);
    CHECK(std::abs(world.velocities()[1].x - v) < 1e-12);
}

TEST_CASE("the assembled and the matrix-free operator take the same steps")
{
    on_every_device([](const auto& device) {
        if (!device->limits().float64)
            return;
        for (const std::uint32_t newton : {1u, 3u})
        {
            Scene assembled = crumpled(5, "assembled"), free = crumpled(5, "matrix_free");
            assembled.method.iterations = free.method.iterations = newton;
            World a(assembled, device), b(free, device);
            run(a, 5);
            run(b, 5);
            CHECK(largest_distance(a.positions(), b.positions()) < 1e-11);
            CHECK(largest_distance(a.positions(), assembled.bodies[0].start_positions) > 0.01);
            const SolverReport report = b.solver_report();
            CHECK(report.solves == 5 * newton);
            CHECK(report.iterations > 5 * newton);
            CHECK((report.limited == 0 && report.failed == 0));
        }
    });
}

TEST_CASE("both preconditioners take the same steps, and two levels take fewer iterations for them")
{
    on_every_device([](const auto& device) {
        if (!device->limits().float64)
            return;
        Scene blocks = implicit(test::hanging(40));
        blocks.bodies[0].material.stretch_stiffness = 1e4;
        blocks.bodies[0].material.bending_stiffness = 1e-3;
        blocks.method.linear_tolerance = 1e-8;
        blocks.method.linear_iterations = 4000;
        Scene levels = blocks;
        levels.method.preconditioner = NewtonPreconditioner::two_level;
        World a(blocks, device), b(levels, device);
        run(a, 3);
        run(b, 3);
        const SolverReport one = a.solver_report(), two = b.solver_report();
        note("two levels", *device, "share of iterations", double(two.iterations) / double(one.iterations));
        CHECK(largest_distance(a.positions(), b.positions()) < 1e-7);
        CHECK(largest_distance(b.positions(), b.scene().bodies[0].mesh.positions) > 1e-4);
        CHECK((two.limited == 0 && two.failed == 0));
        CHECK(4 * two.iterations < 3 * one.iterations);
    });
}

TEST_CASE("two levels hold what stands still, and what colliders hold in further Newton steps")
{
    // (Later the search along a step decides otherwise where a residual differs in its 13th digit.)
    // Light vertices among heavy ones: where a ball pushes them their rows leave the system between two
    // Newton steps.
    Scene scene = implicit(test::hanging(12));
    scene.method.preconditioner = NewtonPreconditioner::two_level;
    scene.method.iterations = 3;
    scene.method.linear_iterations = 4000;
    scene.bodies[0].vertex_masses.assign(169, 0.002);
    for (std::uint32_t v = 0; v < 169; v += 7)
        scene.bodies[0].vertex_masses[v] = 0.00002;
    Collider ball;
    ball.point = {0.5, -0.35, 0};
    ball.radius = 0.3;
    scene.colliders = {ball};
    Scene blocks = scene;
    blocks.method.preconditioner = NewtonPreconditioner::block_jacobi;
    World a(blocks, test_device("cpu:serial")), b(scene, test_device("cpu:serial"));
    run(a, 12);
    run(b, 12);
    CHECK(largest_distance(a.positions(), scene.bodies[0].mesh.positions) > 0.01);
    CHECK(a.solver_report().failed + a.solver_report().limited == 0);
    CHECK(b.solver_report().failed + b.solver_report().limited == 0);
    CHECK(largest_distance(a.positions(), b.positions()) < 1e-6);
    CHECK(judge(SceneBudget(a.scene()), a).sound()); // they start within the ball, and are not out of it yet
    CHECK(judge(SceneBudget(b.scene()), b).sound());
}

TEST_CASE("free fall is exact with one iteration of the solver, however stiff the cloth")
{
    on_every_device([](const auto& device) {
        for (const double stiffness : {1e3, 1e8})
        {
            Scene scene = implicit(free_cloth(6, stiffness, 1e-2));
            scene.gravity = {0, -9.81, 0};
            scene.method.precision = Precision::float32;
            scene.method.linear_iterations = 1;
            scene.method.linear_tolerance = 1e-5;
            World world(scene, device);
            const std::vector<glm::dvec3> before = world.positions();
            run(world, 60);
            double worst = 0;
            for (std::size_t v = 0; v < before.size(); ++v)
                worst = std::max(worst, std::abs(before[v].y - world.positions()[v].y - 4.905));
            note("free fall", *device, "largest error of 4.905 m", worst);
            CHECK(worst < 1e-5);
            CHECK(measure(world).momentum_error < 1e-5);
        }
    });
}

TEST_CASE("momentum is kept while cloth unfolds")
{
    on_every_device([](const auto& device) {
        if (!device->limits().float64)
            return;
        Scene scene = crumpled(6, "assembled");
        scene.method.linear_iterations = 5; // cut short
        World world(scene, device);
        run(world, 60);
        const StepReport report = check_sound(world, {"iteration_limit"});
        const PhysicalModel model = make_model(scene);
        glm::dvec3 momentum(0);
        double mass = 0;
        for (std::size_t v = 0; v < model.mass.size(); ++v)
        {
            momentum += model.mass[v] * world.velocities()[v];
            mass += model.mass[v];
        }
        const double speed = glm::length(momentum) / mass;
        note("momentum", *device, "speed of the centre of mass, m/s", speed);
        CHECK(speed < 1e-13);
        CHECK(report.max_speed > 0.1);
    });
}

TEST_CASE("a clamped net settles to the static answer with four iterations a solve")
{
    // Methods, finding 1: at rest the right-hand side is zero, so a truncated solve has no error.
    Scene scene = clamped_net(17, 2);
    scene.method.linear_iterations = 4;
    scene.method.linear_operator = GENERATE(LinearOperator::assembled, LinearOperator::matrix_free);
    scene.damping = 5;
    World world(scene, test_device("cpu"));
    run(world, 600);
    const double sag = -world.positions()[17 * 8 + 8].z;
    note("A4", *test_device("cpu"), "sag / golden - 1", sag / 0.029071613860554 - 1);
    CHECK(sag == Approx(0.029071613860554).epsilon(1e-9));
    CHECK(world.solver_report().most <= 4);
}

TEST_CASE("a bent strip at rest is that of Newton's method on the same energy")
{
    Scene scene;
    Body body;
    body.shape.cells = {8, 2};
    body.shape.size = {0.4, 0.1};
    body.material.stretch_stiffness = 2000;
    body.material.bending_stiffness = 1e-3;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.use_box = true;
    pin.box_min = {-0.21, -1, -1};
    pin.box_max = {-0.149, 1, 1};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 4;
    scene = implicit(resolve(scene));
    scene.method.linear_iterations = 20;
    World world(scene, test_device("cpu"));
    run(world, 1200);
    const PhysicalModel model = make_model(scene);
    const StaticReference reference = solve_static(model, model.start);
    REQUIRE(reference.converged);
    const auto error =
        displacement_error(error_weights(model), world.positions(), reference.positions, model.start);
    REQUIRE(error.has_value());
    note("strip", *test_device("cpu"), "e_disp", *error);
    CHECK(*error < 1e-6);
    CHECK(world.positions()[8].y < -0.01); // it does hang
}

TEST_CASE("the error against small explicit steps falls with the first power of the step")
{
    Scene scene = implicit(test::hanging(3));
    scene.bodies[0].material.stretch_stiffness = 20;
    scene.bodies[0].material.bending_stiffness = 1e-3;
    scene.duration = 0.5;
    const PhysicalModel model = make_model(scene);
    const DynamicReference reference = solve_dynamic(model);
    INFO(reference.reason);
    REQUIRE(reference.verified);
    std::vector<double> errors;
    for (const std::uint32_t substeps : {16u, 32u, 64u})
    {
        scene.method.substeps = substeps;
        World world(scene, test_device("cpu"));
        Frames frames = {world.positions()};
        for (std::size_t i = 1; i < reference.frames.size(); ++i)
        {
            world.step();
            frames.push_back(world.positions());
        }
        errors.push_back(trajectory_error(error_weights(model), frames, reference.frames).value());
        note("order", *test_device("cpu"), "e_traj", errors.back());
    }
    CHECK(std::log2(errors[0] / errors[1]) == Approx(1).margin(0.15));
    CHECK(std::log2(errors[1] / errors[2]) == Approx(1).margin(0.15));
    CHECK(errors[2] < 0.02);
}

TEST_CASE("a line search never lets the incremental potential rise")
{
    // From rest, crushed to a fifth: without inertia to speak of, energy may only fall.
    Scene scene = crumpled(5, "assembled");
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x = {0.2 * x.x, 0.2 * x.y, 0.3 * x.z};
    scene.bodies[0].material.stretch_stiffness = 1e5;
    scene.timestep = 0.5;
    scene.method.iterations = 4;
    scene.method.line_search = 8;
    scene.method.linear_tolerance = 1e-6;
    World world(scene, test_device("cpu"));
    double before = measure(world).potential_energy;
    for (int i = 0; i < 20; ++i)
    {
        world.step();
        const StepReport report = measure(world);
        CHECK(energy(report) <= before * (1 + 1e-9));
        before = energy(report);
    }
    check_sound(world);
}

TEST_CASE("further Newton steps take the residual of a substep to rounding")
{
    Scene scene = implicit(test::hanging(4));
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x.z += 0.1 * std::sin(5 * x.y);
    std::vector<double> left;
    for (const std::uint32_t newton : {1u, 3u, 12u})
    {
        scene.method.iterations = newton;
        World world(scene, test_device("cpu:serial"));
        run(world, 5);
        left.push_back(measure(world).primal_residual);
        note("r_acc", *test_device("cpu:serial"), "after 1, 3, 12 Newton steps", left.back());
    }
    CHECK(left[0] > 1e-3);
    CHECK(left[1] < 0.1 * left[0]);
    CHECK(left[2] < 1e-6);
}

TEST_CASE("implicit Euler adds what its solves take and nothing else to a plan")
{
    Scene scene = implicit(test::hanging(4));
    scene.method.linear_iterations = 8;
    scene.method.line_search = 0;
    const auto passes = [&] { return make_plan(scene).passes.size(); };
    // Predict, start; force, matrix, product, dot, share of the guess; inverse, begin 3, 8 iterations of 3,
    // residual anew 3, end 6, log; update; finish.
    const std::size_t solve = 1 + 3 + 8 * 3 + 3 + 6 + 1, newton = 2 + solve + 1;
    CHECK(passes() == 2 + newton + 3 + 1);
    scene.method.iterations = 3;
    CHECK(passes() == 2 + 3 * newton + 3 + 1);
    scene.method.line_search = 2;
    CHECK(passes() == 2 + 3 * (newton + 2 * 2) + 3 + 1); // the whole step, its halves; inertia and springs
    scene.method.line_search = 0;
    scene.method.substeps = 5;
    CHECK(passes() == 5 * (2 + 3 * newton + 3 + 1));
    scene.bodies[0].material.bending_stiffness = 1e-4;
    CHECK(passes() == 5 * (2 + 3 * (newton + 1) + 3 + 1));
    const Plan plan = make_plan(scene);
    CHECK(plan.solvers.size() == 1);
    CHECK(plan.effects.back().name == "implicit_euler");
}

TEST_CASE("rigid springs and hinges are refused in words")
{
    std::string text;
    Scene scene = implicit(test::hanging(2));
    scene.bodies[0].material.stretch_stiffness = kInfinity;
    CHECK(refusal_of([&] { make_plan(scene); }, &text) == "unsupported");
    CHECK(text.find("stretch_stiffness") != std::string::npos);
    scene = implicit(test::hanging(2));
    scene.bodies[0].springs = {{0, 8, 1, 0}};
    CHECK(refusal_of([&] { make_plan(scene); }) == "unsupported");
}
