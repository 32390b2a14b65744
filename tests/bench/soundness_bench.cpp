// What it costs to judge a run by physics:
//     taut_soundness_bench [DEVICE]          default cpu:serial
// For each method: a step, a look at the motion, one at the motion and the strains, and one for what passes
// through colliders (medians of the same run of five seconds, ms), the share of the first two in it, and that
// of the third in its first 40 frames, a fall, and in all: it looks eight times, and when something may have
// come as far as a collider's middle. Last what the residuals take, which are measured once, where a run
// ends.

#include "taut/report/crossing.hpp"
#include "taut/report/look_due.hpp"
#include "taut/report/residuals.hpp"
#include "taut/report/soundness_watch.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>

namespace {

using namespace taut;

constexpr int kFall = 40, kFrames = 300;

double ms_of(const std::function<void()>& work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Scene cloth_on_ball()
{
    Scene scene;
    Body body;
    body.shape.cells = {64, 64};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.material.stretch_stiffness = 100;
    scene.bodies = {body};
    Collider ball;
    ball.point = {0, -0.31, 0};
    ball.radius = 0.3;
    scene.colliders = {ball};
    return scene;
}

Scene box_on_floor()
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {12, 12, 12};
    body.material = solid_material();
    scene.bodies = {body};
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -0.51, 0};
    scene.colliders = {floor};
    return scene;
}

void measure_row(const char* name, Scene scene, const char* method, const std::shared_ptr<Device>& device)
{
    scene.method.type = option_named<MethodKind>(method);
    scene.method.stability = StabilityRule::substep;
    World world(scene, device);
    const SceneBudget budget(world.scene());
    CrossingWatch watch(world.scene());
    watch.look(0, 0, world.drive().substep, world.positions(), world.velocities());
    std::vector<double> step, motion, state, crossing = {0};
    double looked = 0;                          // s
    double steps = 0, crossings = 0, falls = 0; // ms
    for (int k = 0; k < kFrames; ++k)
    {
        if (k == kFall)
            falls = crossings / steps;
        step.push_back(ms_of([&] {
            world.step();
            world.device().wait();
        }));
        steps += step.back();
        motion.push_back(ms_of([&] { judge(budget, world, Judged::motion); }));
        state.push_back(ms_of([&] { judge(budget, world); }));
        const bool due = look_due(static_cast<std::uint64_t>(k) + 1, kFrames, kCrossingLooks);
        if (!watch.needed() || (!due && world.time() + world.scene().timestep - looked <= watch.clear_for()))
            continue;
        looked = world.time();
        crossing.push_back(ms_of([&] {
            const std::vector<glm::dvec3> x = world.positions(), v = world.velocities();
            watch.look(static_cast<std::uint64_t>(k), world.time(), world.drive().substep, x, v);
        }));
        crossings += crossing.back();
    }
    const std::uint64_t every = frames_between_looks(world.plan(), kFrames);
    const double looks = double(kFrames) / double(every) * median(motion) + kStrainLooks * median(state);
    const double residuals = ms_of([&] { residuals_ahead(world); });
    std::printf(
        "| %s | %s | %.3g | %.3g | %.3g | %.3g | %llu | %.2f %% | %.2f %% | %.2f %% | %.3g | %.2f %% |\n",
        name, method, median(step), median(motion), median(state), median(crossing),
        static_cast<unsigned long long>(every), 100 * looks / (kFrames * median(step)), 100 * falls,
        100 * crossings / steps, residuals, 100 * residuals / steps);
}

} // namespace

int main(int argc, char** argv)
{
    const std::shared_ptr<Device> device = Device::open(argc > 1 ? argv[1] : "cpu:serial", {});
    std::printf("| scene | method | step | motion | strains | crossings | frames from look to look | share "
                "of looks | of crossings in the fall | of crossings | residuals | of residuals |\n"
                "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const char* method :
         {"xpbd", "pbd", "vbd", "implicit_euler", "implicit_constraints", "mass_spring", "acad"})
        measure_row("cloth 64²", cloth_on_ball(), method, device);
    for (const char* method : {"xpbd", "vbd", "implicit_euler"})
        measure_row("box 12³", box_on_floor(), method, device);
}
