// Plates and membranes in the static reference: slopes of their energy, and strips at rest against closed
// forms.

#include "support/catch.hpp"
#include "support/random.hpp"

#include "taut/report/reference_static.hpp"
#include "taut/report/static_energy.hpp"

#include <Eigen/Dense>

#include <cmath>

using namespace taut;
using reference::Curvature;
using reference::State;
using reference::StaticEnergy;

namespace {

/// A level strip of `cells` that is held by its first ones and weighs `density` (kg/m^2).
PhysicalModel strip(glm::uvec2 cells, glm::dvec2 size, double rigidity, double density, Diagonals diagonals)
{
    Scene scene;
    scene.gravity = {0, -9.81, 0};
    Body body;
    body.shape.cells = cells;
    body.shape.size = size;
    body.shape.diagonals = diagonals;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Material& material = body.material;
    material.density = density;
    material.stretch_stiffness = 0;
    material.fabric.used = true;
    material.fabric.warp = material.fabric.weft = 3e5 * rigidity / (size.y * size.y);
    material.fabric.shear = material.fabric.warp / 2;
    material.bending_stiffness = rigidity;
    material.bending_model = BendingModel::plate;
    Pin pin;
    pin.use_box = true;
    pin.box_min = glm::dvec3(-1);
    pin.box_max = {-size.x / 2 + 1.01 * size.x / cells.x, 1, 1};
    body.pins = {pin};
    scene.bodies.push_back(body);
    return make_model(resolve(scene));
}

/// As a strip starts, but each vertex somewhere within `way` of there.
State scattered(const PhysicalModel& model, double way)
{
    conformance::Random random(7);
    State out;
    for (const glm::dvec3& x : model.start)
        out.push_back({x.x + random.uniform(-way, way), x.y + random.uniform(-way, way),
                       x.z + random.uniform(-way, way)});
    return out;
}

long double& coordinate(State& x, std::size_t vertex, int axis)
{
    return axis == 0 ? x[vertex].x : axis == 1 ? x[vertex].y : x[vertex].z;
}

/// What is left of the system when the moments are eliminated.
Eigen::MatrixXd condensed(const StaticEnergy& energy, const State& x)
{
    const Eigen::MatrixXd lower = energy.system(x, Curvature::exact, 0);
    const Eigen::MatrixXd all = lower.selfadjointView<Eigen::Lower>();
    const int n = energy.unknowns(), m = energy.plate_hinges();
    REQUIRE(m > 0);
    return all.topLeftCorner(n, n) -
           all.topRightCorner(n, m) * all.bottomRightCorner(m, m).lu().solve(all.bottomLeftCorner(m, n));
}

/// Drop over reach of a strip of n cells whose density g L^3 / B is 5.
double drop_over_reach(std::uint32_t n, Diagonals diagonals)
{
    constexpr double kLength = 0.1, kDensity = 0.2;
    const double rigidity = kDensity * 9.81 * std::pow(kLength, 3) / 5;
    const PhysicalModel model =
        strip({n + 1, n / 4}, {kLength * (n + 1) / n, kLength / 4}, rigidity, kDensity, diagonals);
    const StaticReference rest = solve_static(model, model.start);
    CAPTURE(rest.reason, rest.relative_residual);
    REQUIRE((rest.converged && rest.stable));
    glm::dvec3 way(0);
    for (std::uint32_t row = 0; row <= n / 4; ++row)
        way += rest.positions[row * (n + 2) + n + 1] - rest.positions[row * (n + 2) + 1];
    return -way.y / way.x;
}

} // namespace

TEST_CASE("forces of plates and membranes are the slopes of their energy, and stiffness of the forces",
          "[reference]")
{
    const PhysicalModel model = strip({4, 2}, {0.4, 0.2}, 0.01, 0.2, Diagonals::alternating);
    REQUIRE((model.plates.size() > 8 && model.added.size() == 16));
    const StaticEnergy energy(model);
    const State x = scattered(model, 0.02), force = energy.gradient(x);
    const Eigen::MatrixXd stiffness = condensed(energy, x);
    const double size = reference::largest_component(force);
    double worst_force = 0, worst_slope = 0;
    const auto take = [](double& worst, double off) { // what is no number stays
        if (!(std::abs(off) <= worst))
            worst = std::abs(off);
    };
    for (std::size_t i = 0; i < x.size(); ++i)
        for (int axis = 0; axis < 3 && energy.unknown(i) >= 0; ++axis)
        {
            State ahead = x, behind = x;
            const long double h = 1e-7L;
            coordinate(ahead, i, axis) += h;
            coordinate(behind, i, axis) -= h;
            State own = force;
            const long double slope = (energy.value(ahead) - energy.value(behind)) / (2 * h);
            take(worst_force, static_cast<double>(slope - coordinate(own, i, axis)));
            State up = energy.gradient(ahead), down = energy.gradient(behind);
            for (std::size_t j = 0; j < x.size(); ++j)
                for (int row = 0; row < 3 && energy.unknown(j) >= 0; ++row)
                {
                    const auto change =
                        static_cast<double>((coordinate(up, j, row) - coordinate(down, j, row)) / (2 * h));
                    take(worst_slope, change - stiffness(energy.unknown(j) + row, energy.unknown(i) + axis));
                }
        }
    CHECK(worst_force < 1e-8 * size);
    CHECK(worst_slope < 1e-9 * stiffness.cwiseAbs().maxCoeff());
}

TEST_CASE("a strip of a plate at rest comes to the heavy elastica with its mesh", "[reference]")
{
    constexpr double kElastica = 0.58572; // H / W of theta'' = -5 (1 - s) cos theta
    for (const Diagonals diagonals : {Diagonals::alternating, Diagonals::uniform})
    {
        const double coarse = drop_over_reach(8, diagonals) / kElastica - 1;
        const double fine = drop_over_reach(32, diagonals) / kElastica - 1;
        CAPTURE(coarse, fine);
        CHECK(std::abs(coarse) < 0.035);
        CHECK(std::abs(fine) < 0.1 * std::abs(coarse));
    }
}

TEST_CASE("a plate that stands on its clamp stays upright below Greenhill's load, and falls aside above it",
          "[reference]")
{
    constexpr double kLength = 0.1, kDensity = 0.2, kGravity = 9.81; // falls at density g L^3 / B = 7.837
    const auto standing = [](double load, bool leave_saddles) {
        const double rigidity = kDensity * kGravity * std::pow(kLength, 3) / load;
        PhysicalModel model =
            strip({9, 2}, {kLength * 9 / 8, kLength / 4}, rigidity, kDensity, Diagonals::alternating);
        model.gravity = {-kGravity, 0, 0}; // towards the clamp
        StaticOptions options;
        options.leave_saddles = leave_saddles;
        StaticReference rest = solve_static(model, model.start, options);
        CHECK(rest.converged);
        return rest;
    };
    const auto aside = [](const StaticReference& rest) {
        return std::abs(rest.positions.back().y) / kLength;
    };
    const StaticReference low = standing(6.5, false), saddle = standing(9.5, false),
                          high = standing(9.5, true);
    CHECK(low.stable);
    CHECK(aside(low) < 1e-6);
    CHECK(!saddle.stable);
    CHECK(aside(saddle) < 1e-6);
    CHECK(high.stable);
    CHECK(aside(high) > 0.3);
    CHECK(high.energy < saddle.energy);
}

TEST_CASE("plates and membranes that no pin holds have no static reference", "[reference]")
{
    PhysicalModel model = strip({4, 2}, {0.4, 0.2}, 0.01, 0.2, Diagonals::alternating);
    CHECK(solve_static(model, model.start).converged);
    const auto pins = model.pins;
    model.pins.clear();
    CHECK(solve_static(model, model.start).reason.find("not held by any pin") != std::string::npos);
    model.pins = pins;
    model.plates.clear(); // a membrane alone hangs from its edge
    CHECK(solve_static(model, model.start).converged);
}
