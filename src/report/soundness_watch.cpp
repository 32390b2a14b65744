#include "taut/report/soundness_watch.hpp"

#include <algorithm>

namespace taut {

std::uint64_t frames_between_looks(const Plan& plan, std::uint64_t frames)
{
    std::uint64_t moved = 0;
    for (const EffectCost& effect : plan.effects)
        moved += effect.bytes_per_step;
    // A look at a vertex takes as long as steps take for so many bytes (tests/bench/soundness_bench.cpp).
    constexpr std::uint64_t kLookBytes = 8000;
    const std::uint64_t look = kLookBytes * plan.vertex_count;
    const std::uint64_t paid = 100 * look / std::max<std::uint64_t>(moved, 1) + 1;
    const std::uint64_t wanted = frames < kMotionLooks ? paid : frames / kMotionLooks;
    return std::min(wanted, paid);
}

/// Damping of c /s takes 2 c E of a kinetic energy E in a second. Between two looks E swings: by half of the
/// smaller of both on average, where it swings evenly; half of that is counted.
void SoundnessWatch::add_damped(double time, const std::vector<Soundness>& parts, double damping)
{
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        damped_[p] += 2 * damping * 0.25 * std::min(kinetic_[p], parts[p].energy) * (time - time_);
        kinetic_[p] = parts[p].energy;
    }
    time_ = time;
}

bool SoundnessWatch::strains_due(std::uint64_t frame) const
{
    return frames_ >= kMotionLooks && frame * kStrainLooks / frames_ != (frame - 1) * kStrainLooks / frames_;
}

bool SoundnessWatch::due(std::uint64_t frame) const
{
    // A start is where most is wrong at once.
    return frame != 0 && (frame == 1 || every_ == 0 || frame % every_ == 0 || strains_due(frame));
}

void SoundnessWatch::after(std::uint64_t frame, const World& world)
{
    if (every_ == 0)
        every_ = frames_between_looks(world.plan(), frames_);
    if (!due(frame))
        return;
    if (!budget_ || torn_ != world.torn())
        budget_.emplace(world.scene());
    kinetic_.resize(budget_->parts(), 0.0); // tearing parts no body
    damped_.resize(budget_->parts(), 0.0);
    torn_ = world.torn();
    budget_->set_damped(damped_);
    // Strain alone may heal: what a contact leaves in stiff elements is gone a few steps later. What is too
    // fast is not. A share of clamped speeds is for the whole run to have.
    const std::vector<Soundness> parts = budget_->judge_parts(world, Judged::motion);
    const Soundness motion = budget_->judge_whole(world, parts);
    add_damped(world.time(), parts, world.scene().damping);
    if (rank(motion.status) >= rank(Status::diverged))
        found_ = worse(found_, motion);
    else if (strains_due(frame) && !judge(*budget_, world).sound())
        ++unconverged_;
}

} // namespace taut
