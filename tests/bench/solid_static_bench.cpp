// How long it takes until a hanging box lies as near to its equilibrium as XPBD ever comes: XPBD itself, and
// block descent at several settings. The equilibrium is Newton's in fp64 (class R2 of docs/cost.md).

#include "bench.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace bench {
namespace {

constexpr int kFrames = 360; // 6 s: with this damping all has come to rest
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
    body.material.model = "springs";
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
};

taut::Scene with(const taut::Scene& scene, const Setting& setting)
{
    taut::Scene out = scene;
    out.method.type = setting.type;
    out.method.substeps = setting.substeps;
    out.method.iterations = setting.iterations;
    out.method.spectral_radius = setting.spectral_radius;
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
    for (int frame = 0; frame < kFrames; ++frame)
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
    taut::World near(with(scene, {"vbd", 1, 10, 0.95}), device); // only where Newton begins
    for (int frame = 0; frame < kFrames; ++frame)
        near.step();
    taut::StaticReference solved = taut::solve_static(model, near.positions());
    if (!solved.converged || !solved.stable)
        throw std::runtime_error("hanging box: no equilibrium to compare with: " + solved.reason);
    return {taut::error_weights(model), model.start, std::move(solved.positions)};
}

Row row(const Setting& setting, std::size_t tetrahedra, const Course& course, double bound,
        std::vector<double> times, double against)
{
    const bool first = against == 0;
    Row out;
    out.what = std::string(setting.type) + ", " + std::to_string(setting.substeps) + " x " +
               std::to_string(setting.iterations) + (setting.spectral_radius > 0 ? ", accelerated" : "") +
               ", hanging box of " + std::to_string(tetrahedra) +
               " tetrahedra until it stays within e_disp " + taut::shown(100 * bound, 3) + " %";
    out.error = course.furthest;
    if (times.empty())
    {
        out.what += ": not reached, at rest " + taut::shown(100 * course.error.back(), 3) + " %";
        return out;
    }
    out.what += " (" + std::to_string(*course.reached(bound) + 1) + " frames; at rest " +
                taut::shown(100 * course.error.back(), 3) + " %)";
    std::sort(times.begin(), times.end());
    out.milliseconds = times[times.size() / 2];
    out.best = times.front();
    out.ratio = first ? 1 : out.milliseconds / against;
    out.against = first ? "" : "xpbd";
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
    const std::vector<Setting> settings = {{"xpbd", 10, 1},      {"vbd", 1, 1},       {"vbd", 1, 2},
                                           {"vbd", 1, 4},        {"vbd", 2, 1},       {"vbd", 1, 10},
                                           {"vbd", 1, 10, 0.95}, {"vbd", 1, 30, 0.98}};
    std::vector<std::vector<Course>> courses(settings.size());
    for (int turn = 0; turn < kTurns; ++turn)
        for (std::size_t s = 0; s < settings.size(); ++s)
            courses[s].push_back(run(with(scene, settings[s]), device, goal));
    const double bound = kNear * courses[0][0].error.back();
    std::vector<Row> rows;
    for (std::size_t s = 0; s < settings.size(); ++s)
    {
        std::vector<double> times;
        for (const Course& course : courses[s])
            if (const auto frame = course.reached(bound))
                times.push_back(course.milliseconds[*frame]);
        rows.push_back(row(settings[s], scene.bodies[0].mesh.tetrahedra.size(), courses[s][0], bound, times,
                           s == 0 ? 0 : rows[0].milliseconds));
    }
    return rows;
}

} // namespace bench
