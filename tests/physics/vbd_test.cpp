// Vertex block descent: free fall, golden numbers, static nets, convergence.

#include "hard/cases.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Scene by_vbd(Scene scene, std::uint32_t substeps, std::uint32_t iterations)
{
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return scene;
}

/// Methods A4: n x n particles on a metre, the border held, springs 5 % short of their spacing.
Scene net(std::uint32_t n, double sigma, double stiffness = 1000)
{
    const double spacing = 1.0 / (n - 1), rest = spacing / 1.05;
    std::vector<glm::dvec3> places;
    std::vector<std::uint32_t> border;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
        {
            if (i == 0 || j == 0 || i + 1 == n || j + 1 == n)
                border.push_back(static_cast<std::uint32_t>(places.size()));
            places.emplace_back(i * spacing, 0, j * spacing);
        }
    Body body = particles(places, sigma * spacing * spacing);
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
        {
            // Not between two held ones: those would only be a warning.
            if (i + 1 < n && j > 0 && j + 1 < n)
                body.springs.push_back({j * n + i, j * n + i + 1, rest, 1 / stiffness});
            if (j + 1 < n && i > 0 && i + 1 < n)
                body.springs.push_back({j * n + i, (j + 1) * n + i, rest, 1 / stiffness});
        }
    body.pins = {hold(border)};
    Scene scene = alone(body);
    scene.gravity = {0, -9.81, 0};
    scene.damping = 2;
    return scene;
}

double sag(const World& world)
{
    double lowest = 0;
    for (const glm::dvec3& x : world.positions())
        lowest = std::min(lowest, x.y);
    return -lowest;
}

} // namespace

TEST_CASE(
    "vertex block descent lets a stiff free sheet fall the parabola, also from an adaptive start")
{
    on_every_device([](const auto& device) {
        for (const char* start : {"adaptive", "inertial"})
            for (const double stiffness : {1e3, 1e8})
            {
                Scene scene = by_vbd(free_cloth(6, stiffness, 1e-3), 1, 4);
                scene.gravity = {0, -9.81, 0};
                scene.method.start = option_named<SweepStart>(start);
                World world(scene, device);
                run(world, 60);
                const double fall = 9.81 / 2;
                double worst = 0;
                for (std::size_t v = 0; v < world.positions().size(); ++v)
                    worst = std::max(worst, std::abs(world.scene().bodies[0].mesh.positions[v].y -
                                                     world.positions()[v].y - fall));
                note("vbd", *device, "free fall, worst error / fall", worst / fall);
                CHECK(worst < 1e-5 * fall);
                check_sound(world);
            }
    });
}

TEST_CASE("the start from where it was hardly falls: why the adaptive start is there (methods finding 2)")
{
    Scene scene = by_vbd(free_cloth(6, 1e6), 1, 4);
    scene.gravity = {0, -9.81, 0};
    scene.method.start = SweepStart::previous;
    World world(scene, test_device("cpu:serial"));
    run(world, 60);
    CHECK(-world.positions()[0].y + world.scene().bodies[0].mesh.positions[0].y < 0.5 * 4.905);
}

TEST_CASE("the heavy rope has the strains of the golden table (methods A6)")
{
    struct Golden
    {
        double ratio;
        std::uint32_t substeps, iterations;
        double strain;
    };
    const auto device = test_device("cpu:serial");
    for (const Golden& g : {Golden{1, 16, 1, 4.4e-3}, Golden{1, 1, 16, 5.7e-2}, Golden{100, 16, 1, 6.4e-3},
                            Golden{100, 1, 16, 5.8e-2}, Golden{1e4, 16, 1, 0.201}, Golden{1e4, 1, 16, 0.243}})
    {
        INFO(g.ratio << ", " << g.substeps << " x " << g.iterations);
        Scene scene = by_vbd(test::chain(20, 1e5, 0.01), g.substeps, g.iterations);
        scene.bodies[0].vertex_masses[20] = 0.01 * g.ratio;
        scene.method.start = SweepStart::inertial;
        scene.method.precision = Precision::float64;
        scene.damping = 2;
        World world(scene, device);
        run(world, 600);
        const StepReport report = check_sound(world);
        note("A6", *device, "strain / golden", report.max_stretch / g.strain);
        CHECK(report.max_stretch == Approx(g.strain).epsilon(0.1));
    }
}

TEST_CASE(
    "a stretched net sags as Newton's method says, to the last digits from an adaptive start (methods A4)")
{
    on_every_device([](const auto& device) {
        struct Golden
        {
            std::uint32_t n;
            double sigma, sag;
        };
        for (const Golden& g : {Golden{9, 0.2, 0.002997505219159}, Golden{9, 2, 0.028842835827001},
                                Golden{17, 0.2, 0.003024773044504}})
        {
            Scene scene = by_vbd(net(g.n, g.sigma), 1, 4);
            scene.method.precision = Precision::float64;
            World world(scene, device);
            run(world, steps_for(*device, 1200, 600));
            const double error = sag(world) / g.sag - 1;
            note("A4", *device, "sag / golden - 1, adaptive 1 x 4", error);
            CHECK(std::abs(error) < steps_for(*device, 1, 10) * 1e-6);
            check_sound(world);
        }
    });
}

TEST_CASE("the adaptive start rests where the inertial one is biased (methods finding 2)")
{
    const auto device = test_device("cpu:serial");
    double error[2];
    for (const bool adaptive : {false, true})
    {
        Scene scene = by_vbd(net(17, 0.2), 1, 4);
        scene.method.precision = Precision::float64;
        scene.method.start = adaptive ? SweepStart::adaptive : SweepStart::inertial;
        World world(scene, device);
        run(world, 1200);
        error[adaptive] = std::abs(sag(world) / 0.003024773044504 - 1);
        note("A4", *device, adaptive ? "static error, adaptive" : "static error, inertial", error[adaptive]);
    }
    CHECK(error[0] > 0.01);
    CHECK(error[1] < 1e-6 * error[0] + 1e-9);
}

TEST_CASE("with iterations that converge, vertex block descent is implicit Euler (methods A3)")
{
    // One free vertex is one block: a Newton step on a quadratic energy.
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {1.1, 0, 0}});
        body.springs = {{0, 1, 1, 1e-3}};
        body.pins = {hold({0})};
        Scene scene = by_vbd(alone(body), 1, 1);
        scene.timestep = 1.0 / 120;
        scene.method.precision = Precision::float64;
        World world(scene, device);
        run(world, 120);
        CHECK(std::abs(world.positions()[1].x - 1 - 0.001565729438841746) < 1e-14);
        CHECK(std::abs(world.velocities()[1].x - 0.026798328097130026) < 1e-12);
    });
}

namespace {

/// Runs a scene in double by sweeps that converge, and holds each vertex to 1e-6 m of implicit Euler's.
/// Returns the largest stretch at the end.
double stretch_beside_newton(Scene scene, std::uint32_t substeps, int steps)
{
    scene.method.precision = Precision::float64;
    scene = by_vbd(resolve(scene), substeps, 60); // its pins are named by edges
    World vbd(scene, test_device("cpu:serial"));
    scene.method.type = MethodKind::implicit_euler;
    scene.method.iterations = 4;
    scene.method.linear_tolerance = 1e-12;
    World newton(scene, test_device("cpu:serial"));
    run(vbd, steps);
    run(newton, steps);
    const std::vector<glm::dvec3> x = vbd.positions(), y = newton.positions();
    double apart = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        apart = std::max(apart, glm::distance(x[i], y[i]));
    CHECK(apart < 1e-6);
    CHECK(measure(vbd).max_stretch > 1e-3); // it is drawn
    return measure(vbd).max_stretch;
}

} // namespace

TEST_CASE("damped cloth that is drawn apart by its pins is implicit Euler's, with sweeps that converge")
{
    Scene scene = test::hanging(8);
    Body& body = scene.bodies[0];
    body.material.density = 0.2;
    body.material.stretch_stiffness = 600;
    body.material.stretch_damping = 0.01;
    Pin left, right;
    left.edges = {"left"};
    right.edges = {"right"};
    right.motion = {{0, {0, 0, 0}}, {2, {0.9, 0, 0}}}; // the dampers of its springs give with it
    body.pins = {left, right};
    stretch_beside_newton(scene, 10, 6);
}

TEST_CASE("what limits move is no energy that sweeps make: led cloth keeps up with its pins")
{
    const std::string limit = GENERATE("slack", "strain");
    Scene scene = test::hanging(5);
    scene.timestep = 0.01;
    Body& body = scene.bodies[0];
    body.material.stretch_stiffness = 30;
    if (limit == "slack")
        body.material.attachment_slack = 0.02;
    else
        body.material.strain_limit = 0.02;
    Pin top;
    top.edges = {"top"};
    top.motion = {{0, {0, 0, 0}}, {0.2, {0.4, 0.3, 0}}};
    body.pins = {top};
    CAPTURE(limit);
    CHECK(stretch_beside_newton(scene, 20, 40) < 0.5); // held back it was 2.2
}

TEST_CASE("cloth by vertex block descent converges to the reference with order 1")
{
    const auto device = test_device("cpu:serial");
    Scene scene;
    Body body;
    body.shape.cells = {6, 6};
    body.material.stretch_stiffness = 100;
    body.material.bending_stiffness = 1e-3;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -60;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.duration = 0.2;
    scene = resolve(scene);
    scene.method.precision = Precision::float64;
    const PhysicalModel model = make_model(scene);
    const DynamicReference exact = solve_dynamic(model);
    REQUIRE(exact.verified);
    const ErrorWeights weights = error_weights(model);
    double before = 0;
    for (const std::uint32_t substeps : {40u, 80u, 160u})
    {
        World world(by_vbd(scene, substeps, 20), device);
        run(world, static_cast<int>(exact.frames.size()) - 1);
        const double error = distance_by_mass(weights, world.positions(), exact.frames.back()) /
                             distance_by_mass(weights, exact.frames.back(), model.start);
        note("vbd", *device, "error, 40, 80, 160 substeps", error);
        if (before > 0)
            CHECK(std::abs(std::log2(before / error) - 1) < 0.2);
        before = error;
    }
    CHECK(before < 0.01);
}

TEST_CASE("hinges settle where the static reference does")
{
    // A strip held along one edge bends under its weight.
    const auto device = test_device("cpu:serial");
    Scene scene;
    Body body;
    body.shape.cells = {2, 8};
    body.shape.size = {0.1, 0.4};
    body.material.stretch_stiffness = 1e3;
    body.material.bending_stiffness = 2e-3;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.vertices = {0, 1, 2, 3, 4, 5};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 4;
    scene = resolve(scene);
    scene.method.precision = Precision::float64;
    const PhysicalModel model = make_model(scene);
    const StaticReference exact = solve_static(model, model.start);
    REQUIRE(exact.converged);
    World world(by_vbd(scene, 4, 10), device);
    run(world, 900);
    const ErrorWeights weights = error_weights(model);
    const double error = distance_by_mass(weights, world.positions(), exact.positions) /
                         distance_by_mass(weights, exact.positions, model.start);
    note("vbd", *device, "strip, static error", error);
    CHECK(error < 1e-3);
    check_sound(world);
}

TEST_CASE("Chebyshev acceleration takes a stiff net further in the same sweeps, and its guard holds")
{
    const auto device = test_device("cpu:serial");
    const auto residual = [&](double radius, std::uint32_t iterations) {
        Scene scene = by_vbd(net(17, 0.2, 1e4), 1, iterations);
        scene.method.precision = Precision::float64;
        scene.method.start = SweepStart::inertial;
        scene.method.spectral_radius = radius;
        World world(scene, device);
        run(world, 1);
        Scene long_scene = scene;
        long_scene.method.spectral_radius = 0;
        long_scene.method.iterations = 1000;
        World exact(long_scene, device);
        run(exact, 1);
        check_sound(world);
        return largest_distance(world.positions(), exact.positions()) /
               largest_distance(exact.positions(), world.scene().bodies[0].mesh.positions);
    };
    const double plain = residual(0, 32), fast = residual(0.97, 32);
    note("vbd", *device, "error of one step after 32 sweeps, plain", plain);
    note("vbd", *device, "error of one step after 32 sweeps, Chebyshev 0.97", fast);
    CHECK(fast < 0.2 * plain);
    // Fewer than 8 iterations are left alone.
    CHECK(residual(0.97, 4) == residual(0, 4));
    // A radius far too high for the system: bounded by the guard.
    const double reckless = residual(0.9999, 64);
    note("vbd", *device, "error of one step after 64 sweeps, Chebyshev 0.9999", reckless);
    CHECK(reckless < residual(0, 16));
}

TEST_CASE("a stretched sheet keeps its momentum, and at convergence its turning")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(free_cloth(5, 500, 1e-3), 10, 2);
        scene.gravity = {0, -9.81, 0};
        conformance::Random random(3);
        for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            scene.bodies[0].start_positions.push_back(x + glm::dvec3(0, 0, random.uniform(-0.05, 0.05)));
        // Sweeps that do not converge leave forces that are not opposite: unlike constraints they may push.
        double error[2];
        for (const std::uint32_t iterations : {2u, 40u})
        {
            scene.method.iterations = iterations;
            World world(scene, device);
            run(world, 30);
            error[iterations == 40] = check_sound(world).momentum_error;
            note("vbd", *device, iterations == 2 ? "momentum error, 10 x 2" : "momentum error, 10 x 40",
                 error[iterations == 40]);
        }
        CHECK(error[0] < 2e-2);
        CHECK(error[1] < 1e-4);
    });
}
