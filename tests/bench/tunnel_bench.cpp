// How often taut::CrossingWatch notices that cloth and a collider pass through each other, over random runs:
//     taut_tunnel_bench [RUNS] [SEED] [--list]
// One run feeds two judges. The watch looks at most once a frame, as `taut run` has it. The truth looks at
// every substep and shares no code with it: the solid angle under which the cloth appears from the middle of
// the collider jumps by 4 pi when that point goes through the surface, and only then. --list prints each run.

#include "support/solid_angle.hpp"
#include "taut/report/crossing.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

namespace {

using namespace taut;

class Dice
{
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(engine_() >> 11) / 9007199254740992.0;
    }
    double spread(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
    std::uint32_t pick(std::uint32_t count) { return static_cast<std::uint32_t>(between(0, count)); }

private:
    std::mt19937_64 engine_;
};

constexpr double kFrame = 1.0 / 60;
constexpr const char* kHeld[] = {"free", "corners", "edges"};
constexpr const char* kShapes[] = {"ball", "capsule", "box", "plate"};

struct Trial
{
    Scene scene; ///< its time step is a substep
    std::uint32_t frames = 0, substeps = 1;
    double speed = 0, size = 0; ///< m/s; edges
    const char *held = "", *shape = "";
};

Collider random_collider(Dice& dice, double edge, Trial& trial)
{
    Collider out;
    const std::uint32_t shape = dice.pick(4);
    trial.shape = kShapes[shape];
    trial.size = dice.spread(0.2, 6);
    out.radius = trial.size * edge;
    if (shape == 1)
    {
        out.kind = ColliderKind::capsule;
        const glm::dvec3 way(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1));
        out.end = glm::normalize(way) * out.radius * dice.between(0.5, 4);
    }
    if (shape >= 2)
    {
        out.kind = ColliderKind::cuboid;
        out.half_size = glm::dvec3(1, shape == 2 ? 1 : 0.15, dice.between(0.6, 1.5)) * out.radius;
        out.rotate_axis = {dice.between(-1, 1), dice.between(-1, 1), dice.between(0.1, 1)};
        out.rotate_degrees = dice.between(0, 180);
    }
    return out;
}

Trial random_trial(Dice& dice)
{
    constexpr const char* kMethods[] = {"xpbd", "pbd", "vbd", "implicit_euler", "mass_spring"};
    Trial trial;
    Scene& scene = trial.scene;
    Body body;
    const std::uint32_t cells = 6 + dice.pick(15), held = dice.pick(3);
    const double edge = 1.0 / cells;
    body.shape.cells = {cells, cells};
    body.material.stretch_stiffness = dice.spread(300, 30000);
    body.material.bending_stiffness = dice.pick(2) == 0 ? 0 : 1e-4;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    trial.held = kHeld[held];
    if (held > 0)
        body.pins.emplace_back();
    if (held == 1)
        body.pins[0].corners = {"top_left", "top_right", "bottom_left", "bottom_right"};
    if (held == 2)
        body.pins[0].edges = {"top", "bottom", "left", "right"};
    Collider collider = random_collider(dice, edge, trial);
    const double reach = solid_shape(collider).reach + 0.05;
    trial.speed = dice.spread(0.5, 250);
    const glm::dvec3 start(dice.between(-0.25, 0.25), reach, dice.between(-0.25, 0.25));
    const double way = 2 * reach + 0.5;
    trial.frames = 3 + static_cast<std::uint32_t>(std::min(40.0, way / trial.speed / kFrame));
    if (held == 0)
    {
        collider.point += start * glm::dvec3(1, -1, 1);
        collider.end += start * glm::dvec3(1, -1, 1);
        body.velocity = {0, -trial.speed, 0};
    }
    else
    {
        collider.point += start;
        collider.end += start;
        const double time = trial.frames * kFrame;
        collider.motion = {{0, {}}, {time, {0, -trial.speed * time, 0}}};
    }
    scene.bodies = {body};
    scene.colliders = {collider};
    scene.method.type = option_named<MethodKind>(kMethods[dice.pick(5)]);
    scene.method.stability = StabilityRule::substep;
    trial.substeps = 1u << (1 + dice.pick(5));
    scene.method.substeps = 1;
    scene.timestep = kFrame / trial.substeps;
    scene = resolve(scene);
    return trial;
}

struct Outcome
{
    bool through = false; ///< the truth
    Crossings coarse, fine;
    bool finite = true;
};

Outcome run(const Trial& trial)
{
    Outcome out;
    World world(trial.scene, Device::open("cpu:serial"));
    Scene by_frame = trial.scene;
    by_frame.timestep = kFrame;
    CrossingWatch coarse(by_frame), fine(trial.scene);
    const double substep = trial.scene.timestep / world.plan().substeps;
    coarse.look(0, 0, substep, world.positions(), world.velocities());
    fine.look(0, 0, substep, world.positions(), world.velocities());
    test::Truth truth;
    double looked = 0;
    for (std::uint32_t step = 0; step <= trial.frames * trial.substeps; ++step)
    {
        const std::vector<glm::dvec3> x = world.positions(), v = world.velocities();
        truth.look(trial.scene, world.time(), x);
        if (!truth.finite())
            break;
        fine.look(step, world.time(), substep, x, v);
        const bool due = world.time() + kFrame - looked > coarse.clear_for() * (1 - 1e-9);
        const bool last = step == trial.frames * trial.substeps;
        if (step > 0 && step % trial.substeps == 0 && (due || last))
        {
            coarse.look(step / trial.substeps, world.time(), substep, x, v);
            looked = world.time();
        }
        world.step();
    }
    out.through = truth.through();
    out.finite = truth.finite();
    out.coarse = coarse.found();
    out.fine = fine.found();
    return out;
}

struct Tally
{
    int runs = 0, through = 0, noticed = 0, missed = 0, warned = 0, unwarned = 0;
    int pierced = 0, false_alarms = 0, idle_warnings = 0;
};

void count(Tally& tally, const Outcome& o)
{
    const bool seen = !o.coarse.seen.empty(), may = !o.coarse.likely.empty();
    ++tally.runs;
    tally.through += o.through;
    tally.noticed += o.through && seen;
    tally.missed += o.through && !seen;
    tally.warned += o.through && may;
    tally.unwarned += o.through && !may && !seen;
    tally.pierced += !o.through && seen && !o.fine.seen.empty();
    tally.false_alarms += !o.through && seen && o.fine.seen.empty();
    tally.idle_warnings += !o.through && !seen && may;
}

void print(const char* name, const Tally& t)
{
    std::printf("%-10s runs %5d  through %4d: noticed %4d, missed %3d (without any word %d), may_tunnel "
                "%4d | not through: pierced %4d, false alarms %3d, may_tunnel alone %4d\n",
                name, t.runs, t.through, t.noticed, t.missed, t.unwarned, t.warned, t.pierced, t.false_alarms,
                t.idle_warnings);
}

} // namespace

int main(int argc, char** argv)
{
    const int runs = argc > 1 ? std::atoi(argv[1]) : 714;
    Dice dice(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
    const bool list = argc > 3 && std::strcmp(argv[3], "--list") == 0;
    Tally all, slow, fast;
    int refused = 0, unsound = 0;
    for (int k = 0; k < runs; ++k)
    {
        const Trial trial = random_trial(dice);
        try
        {
            const Outcome o = run(trial);
            if (!o.finite)
            {
                ++unsound;
                continue;
            }
            count(all, o);
            count(trial.speed < 5 ? slow : fast, o);
            if (list)
                std::printf("%4d %-14s %-8s %-8s size %5.2f edges, %6.2f m/s, %2u substeps: through %d "
                            "seen %d (passed %d, deep %d) fine %d may %d\n",
                            k, std::string(to_string(trial.scene.method.type)).c_str(), trial.held,
                            trial.shape, trial.size, trial.speed, trial.substeps, o.through,
                            int(o.coarse.seen.size()), int(o.coarse.passed), int(o.coarse.elements),
                            int(o.fine.seen.size()), int(o.coarse.likely.size()));
        }
        catch (const Error& error)
        {
            ++refused;
        }
    }
    print("all", all);
    print("< 5 m/s", slow);
    print(">= 5 m/s", fast);
    std::printf("refused %d, not finite %d\n", refused, unsound);
}
