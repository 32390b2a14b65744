// taut_hybrid_bench [FILE.csv]: serial, parallel, device and both together over grids of 20^2 to 512^2
// vertices, each cut into four cloths so that there is something to divide. Prints the table of
// docs/hybrid.md.

#include "bench.hpp"
#include "conditions.hpp"
#include "ways.hpp"

#include "taut/report/report.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/hybrid.hpp"

#include <cstdio>
#include <exception>
#include <memory>

namespace {

using namespace taut;
using bench::Way;

constexpr std::uint32_t kSides[] = {20, 32, 64, 128, 256, 512};

Scene four_cloths(std::uint32_t side)
{
    Scene scene;
    for (int k = 0; k < 4; ++k)
    {
        Body body;
        body.shape.cells = {side / 2 - 1, side / 2 - 1};
        body.material.stretch_stiffness = 1000;
        body.transform.translate = {2.0 * k, 0, 0};
        Pin pin;
        pin.corners = {"top_left", "top_right"};
        body.pins = {pin};
        scene.bodies.push_back(body);
    }
    scene.method.substeps = 10;
    return resolve(scene);
}

Way on_both(const Scene& scene, const std::string& selector)
{
    const auto world = std::make_shared<HybridWorld>(scene, Device::open("cpu"), Device::open(selector));
    std::string name = "cpu and " + selector;
    for (const HybridPart& part : world->parts())
        name += ", " + std::to_string(part.bodies.size());
    return {name, [world] { world->step(); }, [world] { return world->positions(); }};
}

std::vector<Way> ways_of(const Scene& scene)
{
    std::vector<Way> ways = {bench::on_device(scene, "cpu:serial"), bench::on_device(scene, "cpu")};
    for (const char* selector : {"vulkan", "opengl"})
        try
        {
            ways.push_back(bench::on_device(scene, selector));
            ways.push_back(on_both(scene, selector));
        }
        catch (const Error& error)
        {
            std::fprintf(stderr, "left out: %s: %s\n", selector, error.what());
        }
    return ways;
}

/// The rows of one grid: verified after the same number of steps, timed in turns.
void add_grid(std::uint32_t side, std::string& text, std::string& csv)
{
    const Scene scene = four_cloths(side);
    const std::vector<Way> ways = ways_of(scene);
    std::vector<bench::Rival> rivals;
    for (const Way& way : ways)
        rivals.push_back({way.name, way.step});
    bench::take_turns(rivals, side > 200 ? 5 : 15, 2);
    const auto reference = ways.front().positions();
    for (std::size_t k = 0; k < ways.size(); ++k)
    {
        const double error = bench::largest(ways[k].positions(), reference);
        const double ratio = rivals[k].median() / rivals.front().median();
        char line[200];
        std::snprintf(line, sizeof line, "| %u² | %s | %.3f | %.3f | %.2f | %.2g |\n", side,
                      ways[k].name.c_str(), rivals[k].median(), rivals[k].best(), ratio, error);
        text += line;
        csv += std::to_string(side) + ",\"" + ways[k].name + "\"," + shown(rivals[k].median(), 5) + ',' +
               shown(rivals[k].best(), 5) + ',' + shown(ratio, 4) + ',' + shown(error, 3) + '\n';
    }
}

} // namespace

int main(int argc, char** argv)
try
{
    std::string text = "| vertices | on (bodies of each) | median ms a step | best | to serial | error m |\n"
                       "|---|---|---:|---:|---:|---:|\n";
    std::string csv = "# " + bench::conditions("taut_hybrid_bench", argc, argv) +
                      "\nside,on,median_ms,best_ms,ratio_to_serial,error_m\n";
    for (const std::uint32_t side : kSides)
        add_grid(side, text, csv);
    std::printf("%s", text.c_str());
    if (argc > 1)
        taut::write_file(argv[1], csv);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_hybrid_bench: %s\n", error.what());
    return 1;
}
