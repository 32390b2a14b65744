#pragma once
// The parts of a search for the cheapest setting.

#include "taut/report/cost_reference.hpp"
#include "taut/report/cost_trial.hpp"
#include "taut/report/tune.hpp"

#include <optional>
#include <string>
#include <vector>

namespace taut::tuning {

struct Candidate
{
    MethodSettings settings;
    double prior = 0; ///< ms per simulated second, predicted
    bool own = false; ///< the scene's
};

/// The scene with these settings.
Scene with_method(const Scene& resolved, const MethodSettings& settings);

/// ms per simulated second that a plan takes by its dispatches and bytes: an upper bound where a solver may
/// end before its last iteration.
double prior_ms(const Plan& plan, const DeviceTraits& traits);

/// What the static filter knows of a scene.
struct SceneFacts
{
    double largest_speed = 0; ///< m/s, of the reference
    double shortest = 0;      ///< m, spring above zero length
    double mass_ratio = 1;    ///< between vertices that a spring joins and that move
    std::size_t free_coordinates = 0, springs = 0, rigid = 0;
};
SceneFacts scene_facts(const PhysicalModel& model, const CostReference& reference);

/// Why a setting need not be simulated; empty: it must be. Sets the prior.
std::string filtered(const Scene& resolved, const SceneFacts& facts, const DeviceTraits& traits, double bound,
                     Candidate& candidate);

/// Free fall without pins, colliders, damping and wind: empty when the whole keeps its momentum, else why
/// not.
std::string momentum_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                           const MethodSettings& settings);
/// The rest shape without gravity stays where it is: empty, or why not. Empty, too, where the rest shape
/// pulls by itself (a stretched net).
std::string rest_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                       const MethodSettings& settings);

/// Free vertices displaced by at most 1e-3 of the diagonal along a long wave that dies out towards the pins;
/// `number` picks the wave.
Scene perturbed(const Scene& resolved, std::uint32_t number);

/// A start with its reference.
struct Start
{
    Scene scene; ///< resolved
    PhysicalModel model;
    ErrorWeights weights;
    CostReference reference;
    std::string metric;     ///< "e_traj", "e_disp", "e_L" or "e_V"
    std::size_t frames = 0; ///< moving: of the last rung
};
/// Reference and metric of a scene. Without a reference `reference.verified` is false.
Start make_start(const Scene& resolved, const std::shared_ptr<Device>& device, CostKind kind,
                 const CostOptions& options);
/// e_V over so many frames: the reference is the volume at rest and has no frames.
Start make_volume_start(const Scene& resolved, std::size_t frames);

/// A candidate on one start, rung by rung.
struct Lap
{
    std::optional<double> error; ///< at the last rung that it reached
    std::size_t frames = 0;      ///< of that rung; 0 = at rest
    std::string reason;          ///< why it fell; empty: it passed the last rung
};
/// `bound` holds at the last rung; earlier ones have slack.
Lap run_lap(const Start& start, const std::shared_ptr<Device>& device, const MethodSettings& settings,
            CostKind kind, double bound, double rest_seconds);

} // namespace taut::tuning
