// taut_acad_bench [FILE.csv]: what adaptive activation costs against plain springs when nothing is active,
// and how its cost grows with the share of active springs. Prints the tables of docs/methods/acad.md.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/report/report.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <cstdio>
#include <exception>
#include <memory>

namespace {

using namespace taut;

constexpr int kBodies = 10;
constexpr std::uint32_t kCells = 31; ///< 32 x 32 vertices each

/// Ten cloths of springs without gravity; the first `stretched` of them start 20 % too large, all the others
/// at rest.
Scene cloths(int stretched, const char* method)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    for (int k = 0; k < kBodies; ++k)
    {
        Body body;
        body.shape.cells = {kCells, kCells};
        body.shape.network = {true, 100, 50, 10};
        body.transform.translate = {2.0 * k, 0, 0};
        scene.bodies.push_back(body);
    }
    MethodSettings& m = scene.method;
    m.type = method;
    m.substeps = 32;
    m.stability = "substep";
    m.constrained = "structural";
    m.constraint_compliance = 0;
    m.activate_strain = 0.05;
    m.release = "strain"; // what is active stays so: its target is the threshold
    m.release_strain = 0;
    m.linear_iterations = 16; // of every solve, so that the cost of one does not depend on what it finds
    m.linear_tolerance = 1e-30;
    Scene out = resolve(scene);
    for (int k = 0; k < stretched; ++k)
    {
        Body& body = out.bodies[static_cast<std::size_t>(k)];
        body.start_positions = body.mesh.positions;
        for (glm::dvec3& x : body.start_positions)
            x = body.mesh.positions[0] + 1.2 * (x - body.mesh.positions[0]);
    }
    return out;
}

std::shared_ptr<World> world_of(int stretched, const char* method)
{
    return std::make_shared<World>(cloths(stretched, method), Device::open("cpu:serial"));
}

void step(World& world)
{
    world.step();
    world.device().wait();
}

/// Share of what a straight line through (x, y) leaves unexplained, taken from 1.
double r_squared(const std::vector<double>& x, const std::vector<double>& y)
{
    const double n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
        syy += y[i] * y[i];
    }
    const double covariance = sxy - sx * sy / n;
    return covariance * covariance / ((sxx - sx * sx / n) * (syy - sy * sy / n));
}

} // namespace

int main(int argc, char** argv)
try
{
    const auto springs = world_of(0, "mass_spring"), nothing = world_of(0, "acad");
    std::vector<bench::Rival> rivals = {{"mass_spring", [&] { step(*springs); }},
                                        {"acad, nothing active", [&] { step(*nothing); }}};
    const int shares[] = {1, 2, 4, 6, 8, 10};
    std::vector<std::shared_ptr<World>> worlds;
    for (const int k : shares)
    {
        worlds.push_back(world_of(k, "acad"));
        World& world = *worlds.back();
        rivals.push_back(
            {"acad, " + std::to_string(k) + " of 10 cloths stretched", [&world] { step(world); }});
    }
    bench::take_turns(rivals, 31, 3);
    std::vector<double> x = {0}, y = {rivals[1].median()};
    std::string text = "| what | active share | median ms a step | best | to mass_spring | worst strain |\n"
                       "|---|---:|---:|---:|---:|---:|\n";
    std::string csv = "# " + bench::conditions("taut_acad_bench", argc, argv) +
                      "\nwhat,active_share,median_ms,best_ms,ratio,worst_strain\n";
    for (std::size_t k = 0; k < rivals.size(); ++k)
    {
        const World& world = k == 0 ? *springs : k == 1 ? *nothing : *worlds[k - 2];
        const StepReport report = measure(world);
        const double share = k < 2 ? 0 : report.active_share;
        if (k >= 2)
        {
            x.push_back(share);
            y.push_back(rivals[k].median());
        }
        char line[200];
        std::snprintf(line, sizeof line, "| %s | %.3f | %.3f | %.3f | %.2f | %.4f |\n",
                      rivals[k].name.c_str(), share, rivals[k].median(), rivals[k].best(),
                      bench::paired_ratio(rivals[k], rivals[0]), report.max_stretch);
        text += line;
        csv += '"' + rivals[k].name + "\"," + shown(share, 4) + ',' + shown(rivals[k].median(), 5) + ',' +
               shown(rivals[k].best(), 5) + ',' + shown(bench::paired_ratio(rivals[k], rivals[0]), 4) + ',' +
               shown(report.max_stretch, 4) + '\n';
    }
    std::printf("%s\nR^2 of a straight line through share and time: %.4f\n", text.c_str(), r_squared(x, y));
    if (argc > 1)
        taut::write_file(argv[1], csv);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_acad_bench: %s\n", error.what());
    return 1;
}
