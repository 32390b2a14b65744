#include "taut/runtime/cpu/sharing.hpp"

#include <algorithm>

namespace taut::cpu {
namespace {

Way other_than(Way way) { return way == Way::shared ? Way::alone : Way::shared; }

} // namespace

void Sharing::Times::add(double nanoseconds)
{
    last[next] = nanoseconds;
    next = (next + 1) % kCompared;
}

/// The least: a thread that lost its core for a moment says nothing here. What that costs is kept by the
/// runner's own books, replay by replay.
double Sharing::Times::least() const { return *std::min_element(last.begin(), last.end()); }

void Sharing::took(double nanoseconds)
{
    if (trial_left_ != 0)
    {
        of_tried_.add(nanoseconds);
        if (--trial_left_ == 0)
            end_trial();
        return;
    }
    of_best_.add(nanoseconds);
    --until_trial_;
    const bool rested = until_trial_ + kShortest <= interval_;
    if (until_trial_ == 0 || (rested && of_best_.least() > kSlower * usual_))
    {
        tried_ = other_than(best_);
        trial_left_ = kTrial;
    }
}

void Sharing::end_trial()
{
    const bool better = !compares_ || of_tried_.least() < kGain * of_best_.least();
    if (better)
    {
        best_ = tried_;
        of_best_ = of_tried_;
    }
    if (!compares_) // after the recording's first replays the other way is next
    {
        compares_ = true;
        tried_ = other_than(best_);
        trial_left_ = kTrial;
        return;
    }
    usual_ = of_best_.least();
    interval_ = better ? kShortest : std::min(2 * interval_, kLongest);
    until_trial_ = interval_;
}

} // namespace taut::cpu
