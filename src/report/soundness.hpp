#pragma once
// Whether a run can be believed, judged by physics: energy against what can have been put in, strain, clamped
// speeds, inverted elements. docs/statuses.md says how each bound was chosen.

#include "taut/report/energy_budget.hpp"
#include "taut/runtime/base/status.hpp"

#include <optional>
#include <span>
#include <string>

namespace taut {

/// A state of a run, to be judged. Spans are scene-wide.
struct RunState
{
    const Scene& scene; ///< resolved, as it is now
    std::span<const glm::dvec3> x, v; ///< m, m/s
    WorldDrive drive;
    Precision precision = Precision::float32;
    Events events;
    double vertex_substeps = 0; ///< vertices times substeps so far
};

struct Soundness
{
    Status status = Status::completed; ///< or unconverged, diverged, non_finite
    std::string reason;                ///< a sentence with the numbers; empty when completed
    double energy = 0;                 ///< J: kinetic, and of elements strained beyond accept.stretch
    double energy_most = 0;            ///< J: EnergyBudget::most

    bool sound() const { return status == Status::completed; }
};

/// How bad: 0 completed, 1 unconverged, 2 diverged, 3 anything else but an interruption.
int rank(Status status);

/// The worse of two; of two that are as bad, the first.
Soundness worse(const Soundness& a, const Soundness& b);

/// Factors of EnergyBudget::most: kinetic energy beyond the first, kinetic and strained energy beyond the
/// third is `diverged`; kinetic and strained energy beyond the second is `unconverged`.
inline constexpr double kDivergedKinetic = 2, kUnconvergedEnergy = 1.5, kDivergedEnergy = 100;
/// Coordinates beyond this count as diverged, m.
inline constexpr double kDivergedExtent = 1e12;
/// Share of vertices times substeps whose speed was cut at the scene's own max_speed.
inline constexpr double kClampedShare = 0.01;
/// Share of springs times substeps that implicit_constraints counts as turned.
inline constexpr double kTurnedShare = 0.05;

/// Speeds cut at the scene's max_speed, or by the guard against overflow where it has none, of so many
/// vertices times substeps.
Soundness judge_clamps(const Scene& scene, const Events& events, double vertex_substeps);

/// What moves too fast, is too far away or not finite. Costs a pass over the vertices.
Soundness judge_motion(const EnergyBudget& budget, const RunState& state);

/// That, and what is strained or inverted. Costs a pass over the elements.
Soundness judge_state(const EnergyBudget& budget, const RunState& state);

enum class Judged
{
    motion, ///< by judge_motion
    state,  ///< by judge_state
};
/// A world that runs the scene that `budget` was made of, from its start. Waits.
Soundness judge(const EnergyBudget& budget, const World& world, Judged what = Judged::state);

/// Looks at a run on its way, at least. What that costs: docs/statuses.md.
inline constexpr std::uint64_t kMotionLooks = 8, kStrainLooks = 2;

/// Frames from one look at the motion to the next in a run of so many: kMotionLooks looks, or as many as the
/// bytes that the plan's steps touch pay for at 1 %, where that is more. 1 or more.
std::uint64_t frames_between_looks(const Plan& plan, std::uint64_t frames);

/// Looks at a run of so many frames: at its motion after the first and after each frames_between_looks(), at
/// strains kStrainLooks times.
class SoundnessWatch
{
public:
    explicit SoundnessWatch(std::uint64_t frames) : frames_(frames) {}

    /// Whether after(frame, ...) looks at anything.
    bool due(std::uint64_t frame) const;

    /// After frame `frame` of a run of `world`, or of one in whose state `world` is. Waits where a look is
    /// due.
    void after(std::uint64_t frame, const World& world);

    /// The worst motion that was `diverged` or `non_finite`; what is strained on the way may heal.
    const Soundness& found() const { return found_; }
    /// Looks at which the state was not sound otherwise.
    std::uint64_t unconverged() const { return unconverged_; }

private:
    bool strains_due(std::uint64_t frame) const;
    void add_damped(double time, double kinetic, double damping);

    std::uint64_t frames_, every_ = 0, unconverged_ = 0, torn_ = 0; ///< every_: 0 before the first frame
    std::optional<EnergyBudget> budget_; ///< made at the first look
    Soundness found_;
    double time_ = 0, kinetic_ = 0; ///< s, J: at the last look
    double damped_ = 0;             ///< J: what damping has taken out, at least
};

} // namespace taut
