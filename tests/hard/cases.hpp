#pragma once
// What the hard cases share: every executor, sound states, bodies by hand, measured numbers.
//
// TAUT_NOTES=1 prints one line a measured number, "B18 | vulkan | ratio to origin | 1.02"; the table of
// docs/hard-cases.md is made of them.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"
#include "support/scenes.hpp"

#include "taut/report/model.hpp"
#include "taut/report/report.hpp"
#include "taut/report/residuals.hpp"
#include "taut/report/soundness_watch.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <set>

namespace taut::hard {

using Words = std::set<std::string>;

/// Values of MethodSettings::scheme under pbd.
inline constexpr const char* kPbdSchemes[] = {"coloured", "node_centric", "constraint_centric"};

/// TAUT_HARD_SHORT (as ctest sets it): Vulkan and OpenGL are left out, but where bits of the robustness map
/// are compared on Vulkan, too.
inline bool short_run()
{
    const char* wanted = std::getenv("TAUT_HARD_SHORT");
    return wanted && *wanted;
}

/// Calls f(device) for each executor of this machine.
template <typename F>
void on_every_device(F&& f)
{
    for (const std::string& selector : test_devices())
    {
        if (short_run() && !selector.starts_with("cpu"))
            continue;
        INFO(selector);
        const std::shared_ptr<Device> device = test_device(selector);
        f(device);
        CHECK(device->counters().validation_messages == 0);
    }
}

inline void note(const char* id, const Device& device, const char* what, double value)
{
    if (const char* wanted = std::getenv("TAUT_NOTES"); wanted && *wanted)
        std::printf("%s | %s | %s | %.3g\n", id, device.info().executor.c_str(), what, value);
}

/// Long runs are whole on cpu:serial and shorter elsewhere, where a dispatch of software drivers costs
/// thousands of times its work.
inline int steps_for(const Device& device, int whole, int elsewhere)
{
    return device.info().executor == "cpu:serial" ? whole : elsewhere;
}

inline void run(World& world, int steps)
{
    for (int i = 0; i < steps; ++i)
        world.step();
}

inline bool finite(const std::vector<glm::dvec3>& values)
{
    for (const glm::dvec3& x : values)
        if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
            return false;
    return true;
}

/// The state is finite, the run is completed, and exactly these warnings are up.
inline StepReport check_sound(const World& world, const Words& expected = {})
{
    const StepReport report = measure(world);
    CHECK(finite(world.positions()));
    CHECK(finite(world.velocities()));
    INFO(report.reason);
    CHECK(to_string(report.status) == "completed");
    Words words;
    for (const auto& [word, count] : report.warnings)
        words.insert(word);
    CHECK(words == expected);
    return report;
}

/// The state is finite and no energy came from nowhere: of runs whose sweeps are too few to solve them.
inline StepReport check_lasting(const World& world)
{
    const StepReport report = measure(world);
    CHECK(finite(world.positions()));
    CHECK(finite(world.velocities()));
    INFO(report.reason);
    CHECK((report.status == Status::completed || report.status == Status::unconverged));
    return report;
}

inline double energy(const StepReport& report) { return report.kinetic_energy + report.potential_energy; }

/// Mechanical energy above that of the rest state, J, with gravity.
inline double energy(const World& world) { return energy(measure(world)); }

inline bool same_state(const WorldState& a, const WorldState& b)
{
    return a.position == b.position && a.low == b.low && a.velocity == b.velocity;
}

/// Loose vertices: springs and masses as given, nothing else.
inline Body particles(const std::vector<glm::dvec3>& places, double mass = 1)
{
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh.positions = places;
    body.material.stretch_stiffness = 0;
    body.vertex_masses.assign(places.size(), mass);
    return body;
}

/// One body in no gravity.
inline Scene alone(const Body& body)
{
    Scene scene;
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    return scene;
}

inline Pin hold(std::vector<std::uint32_t> vertices)
{
    Pin pin;
    pin.vertices = std::move(vertices);
    return pin;
}

/// Cloth of n x n cells and 1 m in the plane z = 0, free, no gravity; stretch and bending.
inline Scene free_cloth(std::uint32_t n = 6, double stretch = 1000, double bending = 1e-3)
{
    Scene scene;
    Body body;
    body.shape.cells = {n, n};
    body.material.stretch_stiffness = stretch;
    body.material.bending_stiffness = bending;
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    return resolve(scene);
}

inline double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, glm::distance(a[i], b[i]));
    return worst;
}

/// The code that f throws, as its word; "nothing" if it returns. Its message goes to `text`.
template <typename F>
std::string refusal_of(F&& f, std::string* text = nullptr)
{
    try
    {
        f();
    }
    catch (const Error& error)
    {
        if (text)
            *text = error.what();
        return std::string(to_string(error.code()));
    }
    return "nothing";
}

/// Judges the end of a run that was looked at on its way, by its residuals, too.
inline void judge_end(const World& world, const SoundnessWatch& watch, StepReport& report)
{
    set_status(watch.found(), report);
    if (rank(report.status) < rank(Status::diverged))
        judge_residuals(world.scene(), residuals_ahead(world), report);
}

/// As `taut run` judges it, but for what passes through colliders: on the way, at the end, and by residuals.
inline StepReport judged_run(const Scene& scene, std::uint64_t frames, const std::shared_ptr<Device>& device)
{
    World world(scene, device);
    SoundnessWatch watch(frames);
    for (std::uint64_t k = 1; k <= frames && watch.found().sound(); ++k)
    {
        world.step();
        watch.after(k, world);
    }
    StepReport report = measure(world);
    judge_end(world, watch, report);
    return report;
}

inline const double kNaN = std::numeric_limits<double>::quiet_NaN();
inline const double kInfinity = std::numeric_limits<double>::infinity();

} // namespace taut::hard
