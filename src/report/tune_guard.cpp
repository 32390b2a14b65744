// Laws that every setting must keep, whatever its error on the scene.
#include "taut/report/tune_parts.hpp"

#include "taut/report/is_finite.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/world/separate_start.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace taut::tuning {
namespace {

constexpr std::size_t kMostFrames = 18, kFewestFrames = 6;
constexpr double kMomentum = 1e-3; ///< of M sqrt(g D)
constexpr double kRest = 1e-5;     ///< of the diagonal
constexpr double kPush = 1e-4;     ///< of the diagonal a frame

/// Nothing but the bodies' own forces.
Scene alone(const Scene& resolved, const MethodSettings& settings)
{
    Scene out = with_method(resolved, settings);
    out.colliders.clear();
    out.wind = Wind{};
    out.damping = 0;
    out.max_speed = 0;
    for (Body& body : out.bodies)
        body.velocity = {0, 0, 0};
    return out;
}

bool all_finite(const std::vector<glm::dvec3>& values)
{
    return std::all_of(values.begin(), values.end(), [](const glm::dvec3& v) { return is_finite(v); });
}

/// A number in [0, 1) from two small ones; the same on every machine.
double chance(std::uint32_t number, std::uint32_t which)
{
    std::uint64_t x = 0x9e3779b97f4a7c15ull * (1000003ull * number + which + 1);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/// As many frames as an error is bounded over, within limits. False: the time was up before.
bool steps(World& world, std::size_t frames, const std::function<bool()>& late)
{
    for (std::size_t f = 0; f < std::clamp(frames, kFewestFrames, kMostFrames); ++f)
    {
        if (late && late())
            return false;
        world.step();
        world.device().wait();
    }
    return true;
}

glm::dvec3 direction(std::uint32_t number, std::uint32_t which)
{
    const double z = 2 * chance(number, which) - 1;
    const double turn = 2 * std::numbers::pi * chance(number, which + 1), r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Bodies that start nearer than their thickness push each other out: that is no wandering.
void leave_contact_out(Scene& scene)
{
    scene.contact = {};
    for (Body& body : scene.bodies)
        body.contact = {};
}

} // namespace

Verdict momentum_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                       const MethodSettings& settings, std::size_t frames,
                       const std::function<bool()>& late)
{
    Scene scene = alone(resolved, settings);
    if (glm::length(scene.gravity) == 0)
        scene.gravity = {0, -9.81, 0};
    for (Body& body : scene.bodies)
        body.pins.clear();
    const PhysicalModel model = make_model(scene);
    const ErrorWeights weights = error_weights(model);
    World world(scene, device);
    if (!steps(world, frames, late))
        return std::nullopt;
    const std::vector<glm::dvec3> v = world.velocities();
    if (!all_finite(v))
        return "free fall: a velocity is not finite";
    const double mass = std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
    const double off = momentum_error(weights, v, model.velocity, mass * world.gravity_impulse(),
                                      glm::length(scene.gravity));
    return off <= kMomentum ? "" : "free fall: momentum is off by " + shown(off, 2) + " of M sqrt(g D)";
}

Verdict rest_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                   const MethodSettings& settings, std::size_t frames, const std::function<bool()>& late)
{
    Scene scene = alone(resolved, settings);
    const double weight = std::max(1.0, glm::length(scene.gravity)); // what forces are compared with
    scene.gravity = {0, 0, 0};
    leave_contact_out(scene);
    for (Body& body : scene.bodies)
    {
        if (!body.kinematic.used) // it rests where its motion begins
            body.start_positions.clear();
        for (Pin& pin : body.pins)
            pin.motion.clear(), pin.places.reset();
    }
    scene = with_start(std::move(scene));
    const PhysicalModel model = make_model(scene);
    std::vector<glm::dvec3> force(model.mass.size(), glm::dvec3(0));
    add_forces(model, model.start, force);
    for (std::size_t i = 0; i < force.size(); ++i)
        if (!model.pinned[i] && glm::length(force[i]) > 1e-6 * weight * model.mass[i])
            return "";
    World world(scene, device);
    if (!steps(world, frames, late))
        return std::nullopt;
    const std::vector<glm::dvec3> x = world.positions();
    if (!all_finite(x))
        return "rest: a position is not finite";
    const ErrorWeights weights = error_weights(model);
    const double moved = weights.diameter > 0 ? largest_error(weights, x, model.start) : 0;
    return moved <= kRest ? "" : "rest: a vertex wandered " + shown(moved, 2) + " of the diagonal";
}

Verdict broken_law(const Scene& resolved, const std::shared_ptr<Device>& device,
                   const MethodSettings& settings, CostKind kind, std::size_t frames,
                   const std::function<bool()>& late)
{
    const bool falls = kind != CostKind::at_rest || !held_still(resolved);
    const std::size_t count = kind == CostKind::at_rest ? kMostFrames : frames;
    const Verdict fall = falls ? momentum_guard(resolved, device, settings, count, late) : "";
    return fall && fall->empty() ? rest_guard(resolved, device, settings, count, late) : fall;
}

Scene perturbed(const Scene& resolved, std::uint32_t number)
{
    Scene out = resolved;
    const double speed = kPush * make_model(resolved).diameter / resolved.timestep;
    std::uint32_t body_number = 0;
    for (Body& body : out.bodies)
        body.velocity += speed * direction(number, 2 * body_number++);
    return out;
}

} // namespace taut::tuning
