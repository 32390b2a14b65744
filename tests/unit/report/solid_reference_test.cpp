// References of solids: the bound on their fastest motion, and what explicit small steps say beside Newton's
// equilibrium and a refined method.
#include "support/catch.hpp"
#include "support/symmetric.hpp"

#include "taut/plan/stability.hpp"
#include "taut/report/cost.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/report/static_energy.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <random>

using namespace taut;

namespace {

Scene box(const std::string& model, glm::uvec3 cells, double size, double modulus)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {cells.x, cells.y, cells.z};
    body.shape.box_size = {size, size, size};
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = 0.35;
    scene.bodies = {body};
    return scene;
}

/// Held by its upper face, let go straight.
Scene hung(const std::string& model)
{
    Scene scene = box(model, {2, 2, 2}, 0.5, 2e4);
    Pin pin;
    pin.faces = {"top"};
    scene.bodies[0].pins = {pin};
    scene.duration = 0.5;
    return resolve(scene);
}

std::vector<glm::dvec3> shaken(std::vector<glm::dvec3> x, double size, unsigned seed)
{
    std::mt19937 random(seed);
    for (glm::dvec3& p : x)
        for (int k = 0; k < 3; ++k)
            p[k] += size * (static_cast<double>(random()) / 2147483648.0 - 1);
    return x;
}

/// Largest eigenvalue of M^-1 K over the vertices that move; K by central differences of the forces.
double fastest(const PhysicalModel& model, const std::vector<glm::dvec3>& x)
{
    std::vector<std::pair<std::size_t, int>> unknown;
    for (std::size_t v = 0; v < x.size(); ++v)
        for (int k = 0; k < 3 && !model.pinned[v]; ++k)
            unknown.emplace_back(v, k);
    const auto n = static_cast<Eigen::Index>(unknown.size());
    const double step = 1e-6 * model.diameter;
    Eigen::MatrixXd k(n, n);
    for (Eigen::Index column = 0; column < n; ++column)
    {
        std::vector<glm::dvec3> force[2];
        for (int side = 0; side < 2; ++side)
        {
            std::vector<glm::dvec3> moved = x;
            const auto [v, axis] = unknown[static_cast<std::size_t>(column)];
            moved[v][axis] += side == 0 ? -step : step;
            force[side].assign(x.size(), glm::dvec3(0));
            add_forces(model, moved, force[side]);
        }
        for (Eigen::Index row = 0; row < n; ++row)
        {
            const auto [v, axis] = unknown[static_cast<std::size_t>(row)];
            const auto [w, other] = unknown[static_cast<std::size_t>(column)];
            k(row, column) = (force[0][v][axis] - force[1][v][axis]) / (2 * step) /
                             std::sqrt(model.mass[v] * model.mass[w]);
        }
    }
    return symmetric_eigenvalues(0.5 * (k + k.transpose()))[n - 1];
}

double square(double a) { return a * a; }

/// The trajectory of a scene under implicit Euler in double.
Frames implicit(Scene scene, std::uint32_t substeps, std::size_t frames)
{
    scene.method.type = MethodKind::implicit_euler;
    scene.method.substeps = substeps;
    scene.method.iterations = 2;
    scene.method.linear_iterations = 400;
    scene.method.linear_tolerance = 1e-10;
    scene.method.linear_operator = LinearOperator::matrix_free;
    scene.method.precision = Precision::float64;
    World world(scene, Device::open("cpu:serial"));
    Frames out{world.positions()};
    for (std::size_t f = 0; f < frames; ++f)
    {
        world.step();
        out.push_back(world.positions());
    }
    return out;
}

} // namespace

TEST_CASE("the bound of elastic tetrahedra is above their fastest mode, at rest and deformed", "[solid]")
{
    for (const std::string model : {"neo_hookean", "neo_hookean_simple"})
        for (const bool held : {false, true})
            for (const double shake : {0.0, 0.02, 0.1})
            {
                Scene scene = box(model, {2, 3, 2}, 0.5, 1e5);
                if (held)
                {
                    scene.bodies[0].pins.resize(1);
                    scene.bodies[0].pins[0].faces = {"left"};
                }
                const PhysicalModel made = make_model(resolve(scene));
                const auto x = shaken(made.start, shake, 5);
                const double exact = fastest(made, x), bound = square(frequency_bound(made, x)) / kStiffening;
                CAPTURE(model, held, shake, exact, bound);
                CHECK(bound >= exact);
                CHECK(bound < 6 * exact);
            }
}

TEST_CASE("the bound covers springs with volumes of tetrahedra, and a volume within a surface", "[solid]")
{
    for (const std::string volume : {"tetrahedra", "surface"})
        for (const double shake : {0.0, 0.01, 0.05})
        {
            Scene scene = box("springs", {2, 2, 2}, 0.5, 1e5);
            scene.bodies[0].material.volume = option_named<HeldVolume>(volume);
            scene.bodies[0].material.volume_stiffness = 1e7; // so that the springs do not hide it
            const PhysicalModel made = make_model(resolve(scene));
            REQUIRE(made.volumes.size() + made.surfaces.size() > 0);
            const auto x = shaken(made.start, shake, 9);
            const double exact = fastest(made, x), bound = square(frequency_bound(made, x)) / kStiffening;
            CAPTURE(volume, shake, exact, bound);
            CHECK(bound >= exact);
            CHECK(bound < 20 * exact);
        }
}

TEST_CASE("volumes do not change what a plan takes for the stable step of its springs", "[solid]")
{
    Scene scene = box("springs", {2, 2, 2}, 0.5, 1e5);
    scene.method.type = MethodKind::mass_spring;
    const auto with = [&](double stiffness) {
        scene.bodies[0].material.volume_stiffness = stiffness;
        return rate_bounds(resolve(scene)).stiffness;
    };
    CHECK(with(1e9) == with(0));
}

TEST_CASE("small explicit steps of a hung box are where refined implicit Euler goes", "[solid]")
{
    const std::string model = GENERATE("neo_hookean", "springs");
    const Scene scene = hung(model);
    const PhysicalModel made = make_model(scene);
    const DynamicReference reference = solve_dynamic(made);
    INFO(model << ": " << reference.reason);
    REQUIRE(reference.verified);
    CHECK(reference.orders.back() == Approx(2).margin(0.15));
    const std::size_t frames = reference.frames.size() - 1;
    const ErrorWeights weights = error_weights(made);
    const Frames coarse = implicit(scene, 32, frames), fine = implicit(scene, 64, frames);
    Frames limit = fine; // what first order leaves is halved with the step
    for (std::size_t f = 0; f < limit.size(); ++f)
        for (std::size_t v = 0; v < limit[f].size(); ++v)
            limit[f][v] += fine[f][v] - coarse[f][v];
    const double first = trajectory_error(weights, coarse, reference.frames).value();
    const double second = trajectory_error(weights, fine, reference.frames).value();
    CAPTURE(first, second, reference.error);
    CHECK(second < 0.05);
    CHECK(first / second == Approx(2).epsilon(0.1));
    CHECK(trajectory_error(weights, limit, reference.frames).value() < 0.1 * second);
}

TEST_CASE("a damped box settles where Newton finds its equilibrium", "[solid]")
{
    const std::string model = GENERATE("neo_hookean", "springs");
    Scene scene = hung(model);
    scene.damping = 6;
    scene.duration = 5;
    const PhysicalModel made = make_model(scene);
    const DynamicReference moving = solve_dynamic(made);
    const StaticReference at_rest = solve_static(made, made.start);
    INFO(model << ": " << moving.reason << at_rest.reason);
    REQUIRE(moving.verified);
    REQUIRE(at_rest.converged);
    const ErrorWeights weights = error_weights(made);
    CHECK(displacement_error(weights, moving.frames.back(), at_rest.positions, made.start).value() < 1e-5);
}

TEST_CASE("a study of a moving solid is judged by small explicit steps", "[solid]")
{
    CostOptions options;
    options.substeps = {4, 16};
    options.iterations = {1};
    options.precisions = {Precision::float64};
    options.frames = 20;
    options.timing_seconds = 0;
    const CostStudy study = run_cost(hung("neo_hookean"), Device::open("cpu:serial"), options);
    CHECK(study.reference.name == "R3");
    CHECK(study.constraints == 40);
    REQUIRE(study.points.size() == 2);
    REQUIRE(study.points[1].error.has_value());
    CHECK(*study.points[1].error < *study.points[0].error);
}

TEST_CASE("dampers of springs are not in the model of small explicit steps, and a study says so", "[solid]")
{
    Scene scene = hung("springs");
    scene.bodies[0].material.stretch_damping = 0.01;
    CostOptions options;
    options.substeps = {4};
    options.iterations = {1};
    options.precisions = {Precision::float64};
    options.frames = 4;
    options.timing_seconds = 0;
    const CostStudy study = run_cost(scene, Device::open("cpu:serial"), options);
    REQUIRE_FALSE(study.reference.passed.empty());
    CHECK(study.reference.passed[0].find("dampers") != std::string::npos);
}

TEST_CASE("R2 finds the golden drop of the neo-Hookean cantilever (A5)", "[reference]")
{
    for (const auto& [cells, drop] : {std::pair{glm::uvec3(4, 1, 1), 0.006393940413},
                                      {glm::uvec3(8, 2, 2), 0.012903837800},
                                      {glm::uvec3(16, 4, 4), 0.019500951364}})
    {
        Scene scene;
        scene.gravity = {0, 0, -9.81};
        Body body;
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = cells;
        body.shape.box_size = {1, 0.25, 0.25};
        body.shape.split = BoxSplit::six;
        body.material = solid_material();
        body.material.model = SolidModel::neo_hookean_simple;
        body.material.density = 1000;
        body.material.youngs_modulus = 1e7;
        body.material.poissons_ratio = 0.3;
        body.pins.emplace_back().faces = {"left"};
        scene.bodies = {body};
        const PhysicalModel model = make_model(resolve(scene));
        const StaticReference r = solve_static(model, model.start);
        CAPTURE(cells.x, r.reason);
        REQUIRE(r.converged);
        CHECK(r.stable);
        double sum = 0, count = 0;
        for (std::size_t v = 0; v < model.start.size(); ++v)
            if (model.start[v].x > 0.5 - 1e-9)
            {
                sum += model.start[v].z - r.positions[v].z;
                ++count;
            }
        CHECK(sum / count == Approx(drop).epsilon(1e-8));
    }
}

TEST_CASE("the Hessian of tetrahedra is the derivative of their gradient", "[reference]")
{
    for (const std::string model_name : {"neo_hookean", "neo_hookean_simple", "springs"})
    {
        Scene scene;
        Body body;
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = {1, 1, 1};
        body.material = solid_material();
        body.material.model = option_named<SolidModel>(model_name);
        body.material.youngs_modulus = 10;
        body.pins.emplace_back().vertices = {0};
        scene.bodies = {body};
        const PhysicalModel model = make_model(resolve(scene));
        const reference::StaticEnergy energy(model);
        reference::State x;
        std::mt19937 random(5);
        std::uniform_real_distribution<double> far(-0.3, 0.3);
        for (const glm::dvec3& at : model.start)
            x.push_back({at.x + far(random), at.y + far(random), at.z + far(random)});
        const Eigen::MatrixXd lower = energy.hessian(x, reference::Curvature::exact, 0);
        for (int column = 0; column < energy.unknowns(); ++column)
        {
            reference::State more = x, less = x;
            for (std::size_t v = 0; v < x.size(); ++v)
                for (int k = 0; k < 3; ++k)
                    if (energy.unknown(v) >= 0 && energy.unknown(v) + k == column)
                    {
                        (k == 0 ? more[v].x : k == 1 ? more[v].y : more[v].z) += 1e-6L;
                        (k == 0 ? less[v].x : k == 1 ? less[v].y : less[v].z) -= 1e-6L;
                    }
            const reference::State up = energy.gradient(more), down = energy.gradient(less);
            const long double rise = (energy.value(more) - energy.value(less)) / 2e-6L;
            for (std::size_t v = 0; v < x.size(); ++v)
                for (int k = 0; k < 3; ++k)
                {
                    const int row = energy.unknown(v) + k;
                    if (energy.unknown(v) < 0 || row < column)
                        continue;
                    const auto of = [k](const auto& a) { return k == 0 ? a.x : k == 1 ? a.y : a.z; };
                    const double slope = static_cast<double>((of(up[v]) - of(down[v])) / 2e-6L);
                    CHECK(lower(row, column) == Approx(slope).epsilon(1e-7).margin(1e-6));
                    if (row == column)
                        CHECK(static_cast<double>(of(energy.gradient(x)[v])) ==
                              Approx(static_cast<double>(rise)).epsilon(1e-7).margin(1e-6));
                }
        }
    }
}
