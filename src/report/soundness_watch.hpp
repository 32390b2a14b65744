#pragma once
// Looks at the soundness of a run on its way.

#include "taut/report/scene_budget.hpp"

#include <optional>
#include <vector>

namespace taut {

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
    void add_damped(double time, const std::vector<Soundness>& parts, double damping);

    std::uint64_t frames_, every_ = 0, unconverged_ = 0, torn_ = 0; ///< every_: 0 before the first frame
    std::optional<SceneBudget> budget_; ///< made at the first look
    Soundness found_;
    double time_ = 0;                      ///< s: at the last look
    std::vector<double> kinetic_, damped_; ///< J, a part: at the last look; what damping has taken, at least
};

} // namespace taut
