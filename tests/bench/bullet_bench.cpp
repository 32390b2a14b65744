// taut_bullet_bench [FILE.csv] [N...]: a falling sheet of rigid links by Bullet's btSoftBody and by our pbd
// and xpbd, one thread each, in turns, beside what each has wrong. Prints the tables of docs/cloth.md. N:
// vertices a side.

#include "bench.hpp"
#include "bullet_cloth.hpp"
#include "conditions.hpp"
#include "rod_chain.hpp"

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
#include <stdexcept>

namespace {

using namespace taut;
using Places = std::vector<glm::dvec3>;

constexpr double kSide = 2, kTimestep = 1.0 / 60;       // m, s
constexpr int kFall = 30, kTurns = 57, kWarmUp = 3;     // steps: 0.5 s until errors are taken; 1 s timed
constexpr double kChainStep = 1e-4, kChainError = 1e-8; // s, of the exact motion; m, what half of it may move
constexpr int kHang = 300;                              // steps until a hanging sheet counts as at rest: 5 s
constexpr double kHangDamping = 3;                      // 1/s

struct Setting
{
    const char* engine; ///< "bullet" or a method of ours
    int substeps, iterations;
};

constexpr Setting kSettings[] = {{"bullet", 1, 10}, {"pbd", 1, 10}, {"xpbd", 1, 10},
                                 {"bullet", 10, 1}, {"pbd", 10, 1}, {"xpbd", 10, 1}};

/// n x n vertices of 1 kg, rows, columns and both diagonals rigid, the top edge held. It starts level, or
/// hangs.
Scene sheet(std::uint32_t n, bool hangs)
{
    Scene scene;
    Body body;
    body.shape.cells = {n - 1, n - 1};
    body.shape.size = {kSide, kSide};
    body.shape.network = {true, 1, 1, 0};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = hangs ? 0 : -90;
    body.vertex_masses.assign(std::size_t(n) * n, 1.0);
    Pin pin;
    pin.edges = {"top"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.timestep = kTimestep;
    scene.damping = hangs ? kHangDamping : 0;
    scene = resolve(scene);
    for (Body::Spring& s : scene.bodies[0].springs)
        s.compliance = 0;
    return scene;
}

/// One engine with one setting, and how to step it and to look at it.
class Engine
{
public:
    Engine(const Scene& scene, const Setting& setting) : setting_(setting)
    {
        if (std::strcmp(setting.engine, "bullet") == 0)
            bullet_ = std::make_unique<bench::BulletCloth>(for_bullet(scene, setting));
        else
        {
            Scene own = scene;
            own.method.type = setting.engine;
            own.method.substeps = static_cast<std::uint32_t>(setting.substeps);
            own.method.iterations = static_cast<std::uint32_t>(setting.iterations);
            world_ = std::make_unique<World>(own, Device::open("cpu:serial"));
        }
    }

    /// One step of kTimestep. Bullet has no substeps: its whole world takes shorter steps.
    void step()
    {
        if (world_)
        {
            world_->step();
            world_->device().wait();
        }
        else
            for (int k = 0; k < setting_.substeps; ++k)
                bullet_->step();
    }

    Places places() const
    {
        if (world_)
            return world_->positions();
        const std::vector<double> flat = bullet_->places();
        Places out;
        for (std::size_t v = 0; v + 2 < flat.size(); v += 3)
            out.emplace_back(flat[v], flat[v + 1], flat[v + 2]);
        return out;
    }

private:
    static bench::BulletSheet for_bullet(const Scene& scene, const Setting& setting)
    {
        const Body& body = scene.bodies[0];
        bench::BulletSheet out;
        for (const glm::dvec3& x : body.mesh.positions)
            out.places.insert(out.places.end(), {x.x, x.y, x.z});
        for (const Body::Spring& s : body.springs)
            out.links.emplace_back(s.a, s.b);
        for (const Pin& pin : body.pins)
            out.pins.insert(out.pins.end(), pin.vertices.begin(), pin.vertices.end());
        out.timestep = scene.timestep / setting.substeps;
        out.iterations = setting.iterations;
        out.damping = scene.damping;
        return out;
    }

    Setting setting_;
    std::unique_ptr<World> world_;
    std::unique_ptr<bench::BulletCloth> bullet_;
};

struct Stretch
{
    double worst = 0, mean = 0; ///< of (l - L)/L, signed, and of its magnitude
};

Stretch stretch_of(const Scene& scene, const Places& x)
{
    Stretch out;
    std::size_t links = 0;
    for (const Body::Spring& s : scene.bodies[0].springs)
        if (s.kind == SpringKind::structural)
        {
            const double strain = glm::distance(x[s.a], x[s.b]) / s.rest_length - 1;
            out.worst = std::max(out.worst, strain);
            out.mean += std::abs(strain);
            ++links;
        }
    out.mean /= static_cast<double>(links);
    return out;
}

/// The chain of a sheet after `time` s. Throws std::runtime_error when its step is too long to call it exact.
std::vector<glm::dvec2> checked_chain(std::uint32_t n, double time)
{
    const auto chain_of = [&](double step) {
        return bench::fallen_chain(static_cast<int>(n) - 1, kSide / (n - 1), time, step);
    };
    const auto coarse = chain_of(kChainStep), fine = chain_of(kChainStep / 2);
    for (std::size_t k = 0; k < fine.size(); ++k)
        if (!(glm::distance(coarse[k], fine[k]) < kChainError))
            throw std::runtime_error("the exact motion of " + std::to_string(n) +
                                     " rows is not converged: half its step moves a row by " +
                                     shown(glm::distance(coarse[k], fine[k]), 3) + " m; take fewer rows");
    return fine;
}

/// Where the vertices of the level sheet are after `time` s: its columns all move as one chain of rods.
Places exact_fall(const Scene& scene, std::uint32_t n, double time)
{
    const Body& body = scene.bodies[0];
    const double length = kSide / (n - 1);
    const auto chain = checked_chain(n, time);
    const glm::dvec3 held = body.mesh.positions[body.pins[0].vertices.at(0)];
    Places out = body.mesh.positions;
    for (glm::dvec3& x : out)
    {
        const double away = x.z - held.z;
        const glm::dvec2 at = chain.at(static_cast<std::size_t>(std::lround(std::abs(away) / length)));
        x = {x.x, held.y + at.y, held.z + std::copysign(at.x, away)};
    }
    return out;
}

/// Largest distance over the diagonal of the sheet: e_L.
double largest_error(const Places& x, const Places& exact)
{
    double worst = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
        worst = std::max(worst, glm::distance(x[v], exact[v]));
    return worst / (kSide * std::sqrt(2.0));
}

struct Result
{
    std::uint32_t side = 0;
    Setting setting{};
    double median = 0, best = 0, ratio = 0; ///< ms, ms, to Bullet with the same setting
    Stretch stretch;                        ///< after 0.5 s of the fall
    double error = 0;                       ///< e_L of the same frame
    double sag = 0;                         ///< of the hanging sheet, where it sank most, over its height
    double drift = 0;                       ///< largest motion in the last step of that, over the height
};

/// Rigid links at rest hang as long as they are made: whatever a sheet sags from there is error.
void hang(const Setting& setting, std::uint32_t n, Result& result)
{
    const Scene scene = sheet(n, true);
    Engine engine(scene, setting);
    for (int k = 0; k < kHang - 1; ++k)
        engine.step();
    const Places before = engine.places();
    engine.step();
    const Places x = engine.places(), &start = scene.bodies[0].mesh.positions;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        result.sag = std::max(result.sag, (start[v].y - x[v].y) / kSide);
        result.drift = std::max(result.drift, glm::distance(x[v], before[v]) / kSide);
    }
}

std::vector<Result> results_of(std::uint32_t n)
{
    const Scene scene = sheet(n, false);
    const Places exact = exact_fall(scene, n, kFall * kTimestep);
    std::vector<Result> out;
    std::vector<std::unique_ptr<Engine>> engines;
    std::vector<bench::Rival> rivals;
    for (const Setting& setting : kSettings)
    {
        Result result;
        result.side = n;
        result.setting = setting;
        Engine engine(scene, setting);
        for (int k = 0; k < kFall; ++k)
            engine.step();
        const Places x = engine.places();
        result.stretch = stretch_of(scene, x);
        result.error = largest_error(x, exact);
        hang(setting, n, result);
        out.push_back(result);
        engines.push_back(std::make_unique<Engine>(scene, setting));
        rivals.push_back({setting.engine, [&timed = *engines.back()] { timed.step(); }});
    }
    bench::take_turns(rivals, kTurns, kWarmUp);
    for (std::size_t k = 0; k < out.size(); ++k)
    {
        out[k].median = rivals[k].median();
        out[k].best = rivals[k].best();
        out[k].ratio = bench::paired_ratio(rivals[k], rivals[k < 3 ? 0 : 3]);
    }
    return out;
}

std::vector<std::string> cells(const Result& r)
{
    const double percent = 100;
    return {std::to_string(r.side) + " x " + std::to_string(r.side),
            std::string(r.setting.engine) + ", " + std::to_string(r.setting.substeps) + " x " +
                std::to_string(r.setting.iterations),
            shown(r.median, 3),
            shown(r.best, 3),
            shown(r.ratio, 3),
            shown(percent * r.stretch.worst, 3),
            shown(percent * r.stretch.mean, 3),
            shown(percent * r.error, 3),
            shown(percent * r.sag, 3),
            shown(percent * r.drift, 2)};
}

} // namespace

int main(int argc, char** argv)
try
{
    const std::vector<std::string> head = {"vertices",       "engine, steps x iterations",
                                           "median ms",      "best ms",
                                           "to Bullet",      "worst stretch %",
                                           "mean stretch %", "e_L after 0.5 s %",
                                           "sag at rest %",  "last motion %"};
    std::string text, csv = "# " + bench::conditions("taut_bullet_bench", argc, argv) + "; Bullet " +
                            std::to_string(bench::BulletCloth::version()) + "\n";
    const auto add = [&](const std::vector<std::string>& row) {
        for (std::size_t k = 0; k < row.size(); ++k)
        {
            text += (k == 0 ? "| " : " | ") + row[k];
            csv += (k == 0 ? "" : ",") + csv_cell(row[k]);
        }
        text += " |\n";
        csv += '\n';
    };
    add(head);
    text += "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    for (const std::uint32_t n : bench::sides(argc, argv, 2, {20, 32, 64, 128}))
        for (const Result& result : results_of(n))
            add(cells(result));
    std::fputs(text.c_str(), stdout);
    if (argc > 1)
        write_file(argv[1], csv);
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_bullet_bench: %s\n", error.what());
    return 1;
}
