// How long it takes until a hanging box lies as near to its equilibrium as XPBD ever comes, for XPBD of one,
// four and sixteen iterations: XPBD itself, and block descent at several settings. Block descent may take
// longer steps: its error at rest does not depend on them, that of XPBD does. The equilibrium is Newton's in
// fp64 (class R2 of docs/cost.md).

#include "bench.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace bench {
namespace {

constexpr double kSeconds = 6; // simulated: with this damping all has come to rest
constexpr int kTurns = 3;
constexpr double kNear = 1.05; // of XPBD's error at rest counts as reached

/// The box of solid_rows, damped so that it comes to rest.
taut::Scene hanging(std::uint32_t cells)
{
    taut::Scene scene;
    taut::Body body;
    body.shape.kind = taut::ShapeKind::box;
    body.shape.box_cells = {cells, cells, cells};
    body.material = taut::solid_material();
    body.material.model = taut::SolidModel::springs;
    body.material.youngs_modulus = 1e6;
    taut::Pin pin;
    pin.faces = {"top"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.timestep = 1.0 / 60;
    scene.damping = 3;
    return taut::resolve(scene);
}

struct Setting
{
    const char* type;
    std::uint32_t substeps, iterations;
    double spectral_radius = 0; ///< vbd: of Chebyshev acceleration
    double timestep = 1.0 / 60; ///< s

    std::string text() const
    {
        std::string out = type;
        out += ", " + std::to_string(substeps) + " x " + std::to_string(iterations);
        if (spectral_radius > 0)
            out += ", spectral radius " + taut::shown(spectral_radius, 3);
        return out + ", steps of " + taut::shown(timestep, 3) + " s";
    }
};

taut::Scene with(const taut::Scene& scene, const Setting& setting)
{
    taut::Scene out = scene;
    out.method.type = taut::option_named<taut::MethodKind>(setting.type);
    out.method.substeps = setting.substeps;
    out.method.iterations = setting.iterations;
    out.method.spectral_radius = setting.spectral_radius;
    out.timestep = setting.timestep;
    return out;
}

/// What errors are counted from.
struct Goal
{
    taut::ErrorWeights weights;
    std::vector<glm::dvec3> start, rest;

    double error(const std::vector<glm::dvec3>& x) const
    {
        return taut::displacement_error(weights, x, rest, start).value_or(0);
    }
};

/// One run: after each frame the time spent in steps so far, and the error.
struct Course
{
    std::vector<double> milliseconds, error;
    double furthest = 0; ///< m, at the end

    /// The frame from which on the error stays within the bound.
    std::optional<std::size_t> reached(double bound) const
    {
        std::size_t frame = error.size();
        while (frame > 0 && error[frame - 1] <= bound)
            --frame;
        return frame < error.size() ? std::optional(frame) : std::nullopt;
    }
};

Course run(const taut::Scene& scene, const std::shared_ptr<taut::Device>& device, const Goal& goal)
{
    using Clock = std::chrono::steady_clock;
    Course out;
    taut::World world(scene, device);
    double spent = 0;
    for (double left = kSeconds; left > 1e-6; left -= scene.timestep)
    {
        const auto from = Clock::now();
        world.step();
        world.device().wait();
        spent += std::chrono::duration<double, std::milli>(Clock::now() - from).count();
        out.milliseconds.push_back(spent);
        out.error.push_back(goal.error(world.positions()));
    }
    const auto x = world.positions();
    for (std::size_t v = 0; v < x.size(); ++v)
        out.furthest = std::max(out.furthest, glm::distance(x[v], goal.rest[v]));
    return out;
}

Goal equilibrium(const taut::Scene& scene, const std::shared_ptr<taut::Device>& device)
{
    const taut::PhysicalModel model = taut::make_model(scene);
    taut::World near(with(scene, {"vbd", 1, 100, 0.95, 0.1}), device); // only where Newton begins
    for (int frame = 0; frame < 30; ++frame)
        near.step();
    taut::StaticReference solved = taut::solve_static(model, near.positions());
    if (!solved.converged || !solved.stable)
        throw std::runtime_error("hanging box: no equilibrium to compare with: " + solved.reason);
    return {taut::error_weights(model), model.start, std::move(solved.positions)};
}

/// Its courses, one a turn; all turns take the same steps, only times differ.
struct Runner
{
    Setting setting;
    std::vector<Course> courses;

    double at_rest() const { return courses[0].error.back(); }
};

/// The times to `bound` in milliseconds, sorted; none when it is never reached.
std::vector<double> times_to(double bound, const Runner& runner)
{
    std::vector<double> times;
    for (const Course& course : runner.courses)
        if (const auto frame = course.reached(bound))
            times.push_back(course.milliseconds[*frame]);
    std::sort(times.begin(), times.end());
    return times;
}

Row row(const Runner& runner, const Runner& rival, double against)
{
    const bool first = &runner == &rival;
    const double bound = kNear * rival.at_rest();
    Row out;
    out.what = runner.setting.text() + ", to e_disp " + taut::shown(100 * bound, 3) + " %";
    out.error = runner.courses[0].furthest;
    const std::vector<double> times = times_to(bound, runner);
    if (times.empty())
    {
        out.what += ": not reached, at rest " + taut::shown(100 * runner.at_rest(), 3) + " %";
        return out;
    }
    out.what += " (" + std::to_string(*runner.courses[0].reached(bound) + 1) + " steps; at rest " +
                taut::shown(100 * runner.at_rest(), 3) + " %)";
    out.milliseconds = times[times.size() / 2];
    out.best = times.front();
    out.ratio = first ? 1 : out.milliseconds / against;
    out.against = first ? "" : "xpbd of " + std::to_string(rival.setting.iterations);
    out.target = first ? 0 : 0.5;
    return out;
}

} // namespace

std::vector<Row> solid_static_rows()
{
    const char* wanted = std::getenv("TAUT_BENCH_CELLS");
    const auto cells = static_cast<std::uint32_t>(wanted ? std::max(1, std::atoi(wanted)) : 16);
    const taut::Scene scene = hanging(cells);
    const auto device = taut::Device::open("cpu");
    const Goal goal = equilibrium(scene, device);
    std::vector<Runner> rivals, ours;
    for (const std::uint32_t iterations : {1u, 4u, 16u})
        rivals.push_back({{"xpbd", 10, iterations}, {}});
    for (const Setting& setting : {Setting{"vbd", 1, 4}, Setting{"vbd", 1, 10, 0.98},
                                   Setting{"vbd", 1, 90, 0.99, 0.1}, Setting{"vbd", 1, 120, 0.99, 0.3}})
        ours.push_back({setting, {}});
    for (int turn = 0; turn < kTurns; ++turn)
        for (std::vector<Runner>* side : {&rivals, &ours})
            for (Runner& runner : *side)
                runner.courses.push_back(run(with(scene, runner.setting), device, goal));
    std::vector<Row> rows;
    for (const Runner& rival : rivals)
    {
        rows.push_back(row(rival, rival, 0));
        const double against = rows.back().milliseconds;
        for (const Runner& runner : ours)
            rows.push_back(row(runner, rival, against));
    }
    return rows;
}

} // namespace bench
