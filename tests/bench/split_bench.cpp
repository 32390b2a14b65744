// taut_split_bench [FILE.csv [SIDE...]]: one cloth of 20^2 to 512^2 vertices (or of SIDE^2) cut between two
// devices, beside one device alone, and the model of what a cut costs with what it was fed. Prints the tables
// of docs/hybrid.md.

#include "bench.hpp"
#include "conditions.hpp"
#include "ways.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/split.hpp"

#include <cstdio>
#include <exception>
#include <memory>
#include <utility>

namespace {

using namespace taut;
using bench::Way;

constexpr std::pair<const char*, const char*> kPairs[] = {
    {"cpu:serial", "cpu:serial"}, {"cpu", "vulkan"}, {"cpu", "opengl"}};

Scene one_cloth(std::uint32_t side)
{
    Scene scene;
    Body body;
    body.shape.cells = {side - 1, side - 1};
    body.material.stretch_stiffness = 1000;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.substeps = 10;
    return resolve(scene);
}

/// A cut cloth, and what the model knew of it before.
struct Split
{
    std::string pair;
    SplitCosts costs;
    std::shared_ptr<SplitWorld> world;
    std::size_t way = 0; ///< of the ways that are timed
};

Way way_of(const Split& split, const std::string& what)
{
    const auto world = split.world;
    const std::vector<HybridPart> parts = world->parts();
    const double twice = static_cast<double>(parts[0].work + parts[1].work);
    char text[120];
    std::snprintf(text, sizeof text, "%s, %.2f%s, %llu exchanges, work %.3f", split.pair.c_str(),
                  world->share(), what.c_str(), static_cast<unsigned long long>(world->exchanges()),
                  twice / static_cast<double>(world->work()));
    return {text, [world] { world->step(); }, [world] { return world->positions(); }};
}

/// The cloth cut where both should end together.
Split split_over(const Scene& scene, const std::string& first, const std::string& second, Exchange exchange)
{
    const auto one = Device::open(first), other = Device::open(second);
    SplitOptions options{{}, -1, exchange};
    Split out{first + " and " + second, SplitWorld(scene, one, other, options).costs(), nullptr};
    options.share = first == second ? 0.5 : even_share(out.costs);
    out.world = std::make_shared<SplitWorld>(scene, one, other, options);
    return out;
}

struct Tables
{
    std::string times, model, csv, model_csv;
};

void add_times(std::uint32_t side, const std::vector<Way>& ways, const std::vector<bench::Rival>& rivals,
               Tables& out)
{
    const auto reference = ways.front().positions();
    for (std::size_t k = 0; k < ways.size(); ++k)
    {
        const double error = bench::largest(ways[k].positions(), reference);
        const double ratio = bench::paired_ratio(rivals[k], rivals.front());
        char line[240];
        std::snprintf(line, sizeof line, "| %u² | %s | %.3f | %.3f | %.2f | %.2g |\n", side,
                      ways[k].name.c_str(), rivals[k].median(), rivals[k].best(), ratio, error);
        out.times += line;
        out.csv += std::to_string(side) + ",\"" + ways[k].name + "\"," + shown(rivals[k].median(), 5) + ',' +
                   shown(rivals[k].best(), 5) + ',' + shown(ratio, 4) + ',' + shown(error, 3) + '\n';
    }
}

/// The longest exchange with which a split is as fast as the faster device alone, ms: from
/// ab/(a + b) + e l = a, with a <= b the times alone and e exchanges of l.
double longest_exchange(const SplitCosts& c)
{
    const double a = std::min(c.first_ms, c.second_ms);
    return a * a / (c.first_ms + c.second_ms) / static_cast<double>(c.exchanges);
}

/// The same solved for b/a: how many times slower the other device may be with the exchange that there is.
double largest_ratio(const SplitCosts& c)
{
    return std::min(c.first_ms, c.second_ms) / (static_cast<double>(c.exchanges) * c.exchange_ms) - 1;
}

void add_model(std::uint32_t side, const Split& split, double measured, Tables& out)
{
    const SplitCosts& c = split.costs;
    const double alone = std::min(c.first_ms, c.second_ms), even = even_share(c), t = split_ms(c, even);
    const double slower = std::max(c.first_ms, c.second_ms) / alone, most = largest_ratio(c);
    const std::string bound = most < 1 ? "none" : shown(most, 2);
    char line[300];
    std::snprintf(line, sizeof line,
                  "| %u² | %s | %.3f | %.3f | %llu | %.1f | %.2f | %.3f | %.3f | %.2f | %.1f | %.1f | "
                  "%s |\n",
                  side, split.pair.c_str(), c.first_ms, c.second_ms,
                  static_cast<unsigned long long>(c.exchanges), 1000 * c.exchange_ms, even, t, measured,
                  alone / t, 1000 * longest_exchange(c), slower, bound.c_str());
    out.model += line;
    out.model_csv += "# model," + std::to_string(side) + ",\"" + split.pair + "\"," + shown(c.first_ms, 5) +
                     ',' + shown(c.second_ms, 5) + ',' + std::to_string(c.exchanges) + ',' +
                     shown(c.exchange_ms, 5) + ',' + shown(even, 4) + ',' + shown(t, 5) + ',' +
                     shown(measured, 5) + '\n';
}

/// The rows of one cloth: verified after the same number of steps, timed in turns.
void add_cloth(std::uint32_t side, Tables& out)
{
    const Scene scene = one_cloth(side);
    std::vector<Way> ways = {bench::on_device(scene, "cpu:serial"), bench::on_device(scene, "cpu")};
    std::vector<Split> splits;
    for (const auto& [first, second] : kPairs)
        try
        {
            Split split = split_over(scene, first, second, Exchange::sweep);
            split.way = ways.size();
            ways.push_back(way_of(split, ""));
            splits.push_back(std::move(split));
            if (std::string(second) == "cpu:serial")
                ways.push_back(way_of(split_over(scene, first, second, Exchange::colour), ", every colour"));
        }
        catch (const Error& error)
        {
            std::fprintf(stderr, "left out: %s: %s\n", second, error.what());
        }
    std::vector<bench::Rival> rivals;
    for (const Way& way : ways)
        rivals.push_back({way.name, way.step});
    bench::take_turns(rivals, side > 200 ? 5 : 15, 2);
    add_times(side, ways, rivals, out);
    for (const Split& split : splits)
        add_model(side, split, rivals[split.way].median(), out);
}

} // namespace

int main(int argc, char** argv)
try
{
    Tables out;
    out.times = "| vertices | on (share of the first) | median ms a step | best | to serial | error m |\n"
                "|---|---|---:|---:|---:|---:|\n";
    out.model =
        "\n| vertices | on | first alone ms | second alone ms | exchanges | exchange µs | even share | "
        "model ms | measured ms | model: gain | gains below µs | second slower by | gains below |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    out.csv = "# " + bench::conditions("taut_split_bench", argc, argv) +
              "\nside,on,median_ms,best_ms,ratio_to_serial,error_m\n";
    std::vector<std::uint32_t> sides = {20, 32, 64, 128, 256, 512};
    if (argc > 2)
        sides.clear();
    for (int k = 2; k < argc; ++k)
        sides.push_back(static_cast<std::uint32_t>(std::stoul(argv[k])));
    for (const std::uint32_t side : sides)
        add_cloth(side, out);
    std::printf("%s%s", out.times.c_str(), out.model.c_str());
    if (argc > 1)
        taut::write_file(argv[1], out.csv + out.model_csv);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_split_bench: %s\n", error.what());
    return 1;
}
