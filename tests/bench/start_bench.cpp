// taut_start_bench [N]: what a run costs besides its steps, as CSV; cloth of N x N cells, 1024 unless told
// otherwise.
//
// Each part of a start and what follows the last step, in seconds of processor time (all threads, so that
// neighbours on the machine count little) and in steps of the same cloth on one core, then how much
// memory the process has held at most up to there, over the bytes that the plan allocates.

#include "conditions.hpp"

#include "taut/report/report.hpp"
#include "taut/report/residuals.hpp"
#include "taut/world/world.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <optional>
#include <stdexcept>

namespace {

using namespace taut;

/// As tests/bench/size_bench.cpp hangs it, under xpbd: with springs along the edges, or a network of six a
/// vertex.
Scene cloth(std::uint32_t cells, bool network)
{
    Scene scene;
    Body body;
    body.shape.cells = {cells, cells};
    body.shape.network = {network, 1e9, 1e9, 2e4};
    body.material.stretch_stiffness = network ? 0 : 1e4;
    body.transform.rotate_degrees = -90;
    body.transform.rotate_axis = {1, 0, 0};
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.substeps = 10;
    return scene;
}

double peak_bytes()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double seconds_of(const std::function<void()>& work)
{
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

struct Part
{
    const char* name;
    double seconds = 0, peak = 0;
};

void print_table(const char* scene, std::uint32_t cells, const std::vector<Part>& parts, double step,
                 double plan_bytes)
{
    for (const Part& part : parts)
        std::printf("\"%s, %u² cells\",\"%s\",%.3f,%.1f,%.1f\n", scene, cells, part.name, part.seconds,
                    part.seconds / step, part.peak / plan_bytes);
}

void measure_start(const char* name, std::uint32_t cells, bool network)
{
    const auto device = Device::open("cpu:serial", {});
    Scene scene = cloth(cells, network);
    std::vector<Part> parts;
    double bytes = 1;
    std::optional<World> world;
    const auto add = [&](const char* part, const std::function<void()>& work) {
        parts.push_back({part, seconds_of(work), peak_bytes()});
    };
    add("meshes, checks", [&] { scene = resolve(scene); });
    add("plan", [&] {
        const Plan plan = make_plan(scene, DeviceTraits{});
        bytes = 0;
        for (const PlanBuffer& buffer : plan.buffers)
            bytes += static_cast<double>(buffer.bytes);
    });
    WorldOptions options;
    options.traits = DeviceTraits{}; // nothing is measured
    add("world (with a plan of its own)", [&] { world.emplace(scene, device, options); });
    add("measurement", [&] { measure(*world); });
    std::vector<double> steps;
    for (int k = 0; k < 3; ++k)
        steps.push_back(seconds_of([&] { world->step(); }));
    std::sort(steps.begin(), steps.end());
    add("residuals at the end", [&] { residuals_ahead(*world); });
    parts.push_back({"a step", steps[1], peak_bytes()});
    print_table(name, cells, parts, steps[1], bytes);
}

/// In a process of its own: what memory was held at most is counted by process.
void measure_apart(const char* name, std::uint32_t cells, bool network)
{
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0)
    {
        measure_start(name, cells, network);
        std::fflush(stdout);
        std::_Exit(0);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
        throw std::runtime_error(std::string("measuring ") + name + " failed");
}

} // namespace

int main(int argc, char** argv)
{
    try
    {
        const std::uint32_t cells = bench::sides(argc, argv, 1, {1024}).front();
        std::printf("# %s\nscene,part,s,steps,\"peak, plans\"\n",
                    bench::conditions("taut_start_bench", argc, argv).c_str());
        measure_apart("springs along edges", cells, false);
        measure_apart("network", cells, true);
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
