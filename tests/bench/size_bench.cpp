// taut_size_bench [FILE.csv FOLDER [N...]]: what a step costs against the size of a cloth, for mass-spring,
// implicit constraint enforcement and PBD, on every executor in turns, with the stretch that it leaves.
// Prints the table of docs/cloth.md; FOLDER gets size_METHOD.svg. N: vertices a side.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/report/svg_plot.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/csv.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>

namespace {

using namespace taut;

constexpr double kSide = 1; // m
constexpr int kLead = 30, kTurns = 9,
              kWarmUp = 1;      // steps: 0.5 s of fall on one core, then the turns from there
constexpr double kApart = 1e-5; // m, that executors may end apart
const char* const kMethods[] = {"mass_spring", "implicit_constraints", "pbd"};
const char* const kExecutors[] = {"cpu:serial", "cpu", "vulkan", "opengl"};

/// One cloth of 0.2 kg/m^2 and one network of springs, whatever the number of vertices.
Scene cloth(std::uint32_t n, const char* method)
{
    Scene scene;
    Body body;
    body.shape.cells = {n - 1, n - 1};
    body.shape.size = {kSide, kSide};
    body.shape.network = {true, 500, 250, 50};
    body.material.density = 0.2;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 2;
    MethodSettings& m = scene.method;
    m.type = option_named<MethodKind>(method);
    m.substeps = m.type == MethodKind::pbd ? 1 : m.type == MethodKind::mass_spring ? 32 : 8;
    m.iterations = m.type == MethodKind::pbd ? 20 : m.iterations;
    m.stability = StabilityRule::substep; // mass_spring takes as many as it needs
    m.constrained = ConstrainedSprings::structural;
    m.constraint_compliance = 0;
    m.linear_iterations = 20;
    m.linear_tolerance = 1e-2;
    return resolve(scene);
}

/// Largest (l - L)/L along rows and columns.
double worst_stretch(const World& world)
{
    const auto x = world.positions();
    double worst = 0;
    for (const Body::Spring& s : world.scene().bodies[0].springs)
        if (s.kind == SpringKind::structural)
            worst = std::max(worst, glm::distance(x[s.a], x[s.b]) / s.rest_length - 1);
    return worst;
}

void step(World& world)
{
    world.step();
    world.device().wait();
}

struct Result
{
    std::string method, executor;
    std::uint32_t side = 0;
    double median = 0, ratio = 0; ///< ms a step; to cpu:serial
    double stretch = 0;           ///< after the fall
};

/// What computes something else is not timed: throws std::runtime_error.
void check_together(const World& a, const World& b, const Result& of)
{
    const auto x = a.positions(), y = b.positions();
    double apart = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
        apart = std::max(apart, glm::distance(x[v], y[v]));
    if (!(apart <= kApart))
        throw std::runtime_error(of.method + " of " + std::to_string(of.side) + " vertices a side on " +
                                 of.executor + " ends " + shown(apart, 3) + " m from cpu:serial; " +
                                 shown(kApart, 1) + " m are allowed");
}

std::vector<Result> results_of(const char* method, std::uint32_t n)
{
    Scene scene = cloth(n, method);
    World fall(scene, Device::open("cpu:serial"));
    for (int k = 0; k < kLead; ++k)
        step(fall);
    scene.bodies[0].start_positions = fall.positions();
    std::vector<std::unique_ptr<World>> worlds;
    std::vector<bench::Rival> rivals;
    std::vector<Result> out;
    for (const char* executor : kExecutors)
    {
        worlds.push_back(std::make_unique<World>(scene, Device::open(executor)));
        rivals.push_back({executor, [&world = *worlds.back()] { step(world); }});
    }
    bench::take_turns(rivals, kTurns, kWarmUp);
    for (std::size_t k = 0; k < worlds.size(); ++k)
    {
        out.push_back({method, kExecutors[k], n, rivals[k].median(),
                       bench::paired_ratio(rivals[k], rivals[0]), worst_stretch(fall)});
        check_together(*worlds[0], *worlds[k], out.back());
    }
    return out;
}

Plot diagram(const std::string& method, const std::vector<Result>& results)
{
    Plot plot;
    plot.title = "A step of " + method + " against the size of the cloth";
    plot.x_label = "vertices";
    plot.y_label = "ms a step";
    plot.front = false;
    std::string strains;
    for (const char* executor : kExecutors)
    {
        PlotSeries series{executor, {}};
        for (const Result& r : results)
            if (r.method == method && r.executor == executor)
            {
                const std::string stretch = shown(100 * r.stretch, 3) + " %";
                series.points.push_back({double(r.side) * r.side, r.median, "stretch " + stretch});
                if (plot.series.empty())
                    strains += (strains.empty() ? "" : ", ") + stretch + " at " + std::to_string(r.side) +
                               " x " + std::to_string(r.side);
            }
        plot.series.push_back(std::move(series));
    }
    plot.caption = {"Worst stretch along rows and columns after 0.5 s of fall: " + strains + "."};
    return plot;
}

} // namespace

int main(int argc, char** argv)
try
{
    if (argc == 2)
        throw std::runtime_error("the folder for the diagrams is missing; write FILE.csv FOLDER");
    std::vector<Result> results;
    const std::vector<std::uint32_t> all_sides = bench::sides(argc, argv, 3, {16, 32, 64});
    for (const char* method : kMethods)
        for (const std::uint32_t n : all_sides)
            for (Result& result : results_of(method, n))
                results.push_back(std::move(result));
    std::string csv = "# " + bench::conditions("taut_size_bench", argc, argv) +
                      "\nmethod,vertices,executor,median_ms,steps_per_second,to_serial,worst_stretch\n";
    std::puts(
        "| method | vertices | executor | ms a step | steps a second | to cpu:serial | worst stretch % |\n"
        "|---|---:|---|---:|---:|---:|---:|");
    for (const Result& r : results)
    {
        const std::string ms = shown(r.median, 3), rate = shown(1000 / r.median, 3),
                          ratio = shown(r.ratio, 3);
        std::printf("| %s | %u x %u | %s | %s | %s | %s | %s |\n", r.method.c_str(), r.side, r.side,
                    r.executor.c_str(), ms.c_str(), rate.c_str(), ratio.c_str(),
                    shown(100 * r.stretch, 3).c_str());
        csv += csv_cell(r.method) + ',' + std::to_string(r.side * r.side) + ',' + csv_cell(r.executor) + ',' +
               ms + ',' + rate + ',' + ratio + ',' + shown(r.stretch, 4) + '\n';
    }
    if (argc > 2)
    {
        write_file(argv[1], csv);
        for (const char* method : kMethods)
            write_svg(std::filesystem::path(argv[2]) / ("size_" + std::string(method) + ".svg"),
                      diagram(method, results));
    }
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_size_bench: %s\n", error.what());
    return 1;
}
