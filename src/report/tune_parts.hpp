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

/// Throw Error{bad_input} for options that cannot be, the second for a bound on a volume that no body has.
void check_input(const Scene& scene, const TuneOptions& options);
void check_volumes(const Scene& resolved, const TuneOptions& options);

/// The scene's own setting, and the designs of the methods without it.
std::vector<Candidate> designed(const Scene& resolved, const std::vector<MethodKind>& methods,
                                const std::vector<Precision>& precisions);

/// Whether a setting in double was run in float and rejected. A step that diverges in float does so in double
/// too: it counts, though it has no error.
bool fell_in_float(const std::vector<TuneRejection>& rejected, const MethodSettings& settings);

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
    bool stiff = false; ///< an element has a stiffness that is neither 0 nor infinite
    /// (l - L)/L at most in the reference, of all springs and of structural ones; 0 where it has no frames.
    double strain = 0, structural_strain = 0;
    double shortening = 0, structural_shortening = 0; ///< likewise of (L - l)/L
};
SceneFacts scene_facts(const PhysicalModel& model, const CostReference& reference);

/// Why a setting need not be simulated; empty: it must be. Sets the prior.
std::string filtered(const Scene& resolved, const SceneFacts& facts, const DeviceTraits& traits, double bound,
                     Candidate& candidate);

/// What of the scene's material a method replaces by one of its own: empty, or a sentence. pbd has a
/// stiffness without a unit, acad holds springs at a strain, implicit_constraints may be given one compliance
/// for all.
std::string other_material(const SceneFacts& facts, const MethodSettings& settings);

/// Why a law is broken, "" when it is kept, nothing when `late` ended the run before. `frames`: 6 to 18 are
/// run.
using Verdict = std::optional<std::string>;
/// Free fall without pins, colliders, damping and wind: the whole keeps its momentum.
Verdict momentum_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                       const MethodSettings& settings, std::size_t frames,
                       const std::function<bool()>& late = {});
/// The rest shape without gravity stays where it is. Kept, too, where the rest shape pulls by itself (a
/// stretched net).
Verdict rest_guard(const Scene& resolved, const std::shared_ptr<Device>& device,
                   const MethodSettings& settings, std::size_t frames,
                   const std::function<bool()>& late = {});
/// The first of both laws that a setting breaks, looked at over as many frames as the error is bounded. Free
/// fall tells nothing of the rest of what pins hold up.
Verdict broken_law(const Scene& resolved, const std::shared_ptr<Device>& device,
                   const MethodSettings& settings, CostKind kind, std::size_t frames,
                   const std::function<bool()>& late = {});

/// Every body is given a push of 1e-4 of the diagonal a frame; `number` picks the directions.
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

/// Why nothing can be tried by the reference of the scene's own start, which `fits` the bound or does not;
/// what `result` says and an empty text where it can.
std::pair<TuneAnswer, std::string> refusal(const Start& start, bool fits, const TuneResult& result,
                                           const TuneOptions& options);

/// The scene with at least the damping that brings a pendulum as long as it is to rest the fastest. Where
/// bodies come to rest does not depend on it, unless they remember how they got there (contacts, plasticity,
/// tearing): then the scene is as it was.
Scene damped_to_rest(const Scene& resolved);

/// A reference's own error takes at most so much of the bound.
inline constexpr double kReferenceShare = 0.4;
/// Cuts a moving start to the frames whose reference is good enough for the bound. False, and the start
/// stays as it is, when even the first frames are not, when in those nothing has moved yet, or when the rest
/// is not.
bool fit_reference(Start& start, double bound);

/// Reference and metric of a scene. Without a reference `reference.verified` is false.
Start make_start(const Scene& resolved, const std::shared_ptr<Device>& device, CostKind kind,
                 const CostOptions& options);
/// e_V over so many frames: the reference is the volume at rest and has no frames.
Start make_volume_start(const Scene& resolved, std::size_t frames);

/// What is gone of TuneOptions::seconds.
class Watch
{
public:
    explicit Watch(const TuneOptions& options); ///< starts; the options must outlive it
    double spent() const;                       ///< s
    bool over(double part) const { return spent() >= part * options_.seconds; }

private:
    double now() const;
    const TuneOptions& options_;
    double begun_;
};

// What a result says in words, with what would help (tune_words.cpp).
std::string no_reference(const TuneResult& result, const TuneOptions& options);
std::string poor_reference(const TuneResult& result);
std::string unsound_reference(std::uint64_t inverted, const Accept& accept);
std::string none_of_tried(const TuneResult& result);
/// Of the frames that a scene wants: so many have a reference, and so many of those one that is good enough.
std::string frames_note(std::size_t good, std::size_t verified, std::size_t wanted);
/// A note, or none: pins would hold the scene, but nothing damps it.
std::vector<std::string> never_rests_note(const Scene& resolved);
/// Where the bound is not the one that the options have.
std::string loosened_note(const TuneResult& result, const TuneOptions& options);
std::string perturbed_note(std::uint32_t which, const CostReference& reference, double bound);

/// A candidate that was simulated.
struct Ran
{
    Candidate candidate;
    std::optional<double> error; ///< on the scene's own start over all frames, where it went so far
};
/// A candidate that passed everything.
struct Finalist
{
    Candidate candidate;
    double predicted = 0, confirmed = 0;
    std::size_t starts = 0;
    std::optional<cost::Timing> timing;
};

/// A candidate on one start, rung by rung.
struct TrialRun
{
    std::optional<double> error; ///< at the last rung that it reached
    std::size_t frames = 0;      ///< of that rung; 0 = at rest
    std::string reason;          ///< why it fell; empty: it passed the last rung
    bool cut = false;            ///< the time was up: it neither fell nor passed
};
/// `bound` holds at the last rung; earlier ones have slack.
TrialRun run_trial(const Start& start, const std::shared_ptr<Device>& device, const MethodSettings& settings,
                   CostKind kind, double bound, double rest_seconds,
                   const std::function<bool()>& enough = {});

} // namespace taut::tuning
