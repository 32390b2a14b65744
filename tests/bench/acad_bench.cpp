// taut_acad_bench [FILE.csv]: what adaptive activation costs against plain springs when nothing is active,
// and how its cost grows with the share of active springs. Prints the tables of docs/methods/acad.md.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/report/report.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>

namespace {

using namespace taut;

constexpr int kBodies = 10;
constexpr std::uint32_t kCells = 31; ///< 32 x 32 vertices each

/// A row of the table: of ten cloths of springs without gravity `active` start `size` times as large as they
/// are at rest, the others at rest.
struct Setting
{
    std::string name;
    const char* method = "acad";
    int active = 0;
    double size = 1.2;
    bool compress = false;
};

std::vector<Setting> settings()
{
    std::vector<Setting> out = {{"mass_spring", "mass_spring"}, {"acad, nothing active"}};
    for (const int k : {1, 2, 4, 6, 8, 10})
        out.push_back({"acad, " + std::to_string(k) + " of 10 cloths stretched", "acad", k});
    out.push_back({"compress, nothing active", "acad", 0, 1, true});
    out.push_back({"compress, 4 of 10 cloths stretched", "acad", 4, 1.2, true});
    out.push_back({"mass_spring, 4 of 10 cloths pressed", "mass_spring", 4, 0.8, false});
    out.push_back({"acad, 4 of 10 cloths pressed", "acad", 4, 0.8, false});
    out.push_back({"compress, 4 of 10 cloths pressed", "acad", 4, 0.8, true});
    return out;
}

Scene cloths(const Setting& setting)
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
    m.type = option_named<MethodKind>(setting.method);
    m.compress = setting.compress;
    m.substeps = 32;
    m.stability = StabilityRule::substep;
    m.constrained = ConstrainedSprings::structural;
    m.constraint_compliance = 0;
    m.activate_strain = 0.05;
    m.release = ReleaseRule::strain; // what is active stays so: its target is the threshold
    m.release_strain = 0;
    m.linear_iterations = 16; // of every solve, so that the cost of one does not depend on what it finds
    m.linear_tolerance = 1e-30;
    Scene out = resolve(scene);
    for (int k = 0; k < setting.active; ++k)
    {
        Body& body = out.bodies[static_cast<std::size_t>(k)];
        body.start_positions = body.mesh.positions;
        for (glm::dvec3& x : body.start_positions)
            x = body.mesh.positions[0] + setting.size * (x - body.mesh.positions[0]);
    }
    return out;
}

/// Least (l - L)/L of the structural springs.
double least_strain(const World& world)
{
    const std::vector<glm::dvec3> x = world.positions();
    double least = 0;
    std::size_t first = 0;
    for (const Body& body : world.scene().bodies)
    {
        for (const StretchElement& e : stretch_elements(body))
            if (e.kind == SpringKind::structural)
                least = std::min(least, glm::distance(x[first + e.a], x[first + e.b]) / e.rest_length - 1);
        first += body.mesh.positions.size();
    }
    return least;
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
    const std::vector<Setting> all = settings();
    std::vector<std::shared_ptr<World>> worlds;
    std::vector<bench::Rival> rivals;
    for (const Setting& setting : all)
    {
        worlds.push_back(std::make_shared<World>(cloths(setting), Device::open("cpu:serial")));
        World& world = *worlds.back();
        rivals.push_back({setting.name, [&world] { step(world); }});
    }
    bench::take_turns(rivals, 31, 3);
    std::vector<double> x, y; // of stretched cloths, for the line
    std::string text =
        "| what | active share | median ms a step | best | to mass_spring | worst strain | least |\n"
        "|---|---:|---:|---:|---:|---:|---:|\n";
    std::string csv = "# " + bench::conditions("taut_acad_bench", argc, argv) +
                      "\nwhat,active_share,median_ms,best_ms,ratio,worst_strain,least_strain\n";
    for (std::size_t k = 0; k < rivals.size(); ++k)
    {
        const StepReport report = measure(*worlds[k]);
        const double share = std::max(report.active_share, 0.0), least = least_strain(*worlds[k]);
        if (all[k].method == std::string("acad") && !all[k].compress && all[k].size > 1)
        {
            x.push_back(share);
            y.push_back(rivals[k].median());
        }
        const double ratio = bench::paired_ratio(rivals[k], rivals[0]);
        char line[240];
        std::snprintf(line, sizeof line, "| %s | %.3f | %.3f | %.3f | %.2f | %.4f | %.4f |\n",
                      rivals[k].name.c_str(), share, rivals[k].median(), rivals[k].best(), ratio,
                      report.max_stretch, least);
        text += line;
        csv += '"' + rivals[k].name + "\"," + shown(share, 4) + ',' + shown(rivals[k].median(), 5) + ',' +
               shown(rivals[k].best(), 5) + ',' + shown(ratio, 4) + ',' + shown(report.max_stretch, 4) + ',' +
               shown(least, 4) + '\n';
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
