#pragma once
// Whether a recording is faster on one thread or on several, found by running it both ways.
//
// Threads that take turns in writing the same vertices fetch them from each other's caches. What that costs
// depends on where the system has put the threads (a line takes 100 ns on its way between two cores, or 500),
// so it is neither known beforehand nor seen in the time of a pass on one thread. It is measured: in a trial
// of a few replays the way that is not in use runs, and takes over if it needs less time.

#include <array>
#include <cstdint>

namespace taut::cpu {

enum class Way : std::uint8_t
{
    alone, ///< the calling thread runs everything
    shared ///< the pool's threads help where a section has enough work
};

/// Decides how each replay of one recording runs. Decides nothing but time: results are the same either way.
/// One thread at a time.
class Sharing
{
public:
    /// The way of the next replay. `took` tells how long it took before the next call.
    Way next() const { return trial_left_ != 0 ? tried_ : best_; }

    /// The way in use: what a replay takes that is not measured.
    Way best() const { return best_; }

    /// Time of the replay that `next` has decided [ns], at least 0.
    void took(double nanoseconds);

private:
    static constexpr std::uint32_t kCompared = 3;  ///< replays of each way that are compared
    static constexpr std::uint32_t kTrial = 4;     ///< one more: the first fetches what the others had
    static constexpr std::uint32_t kShortest = 16; ///< replays between two trials, after a change of way
    static constexpr std::uint32_t kLongest = 512; ///< when no trial has changed anything for long
    static constexpr double kGain = 0.97;          ///< of the time: what a change must be worth
    static constexpr double kSlower = 1.25;        ///< of the usual time: what brings the next trial forward

    /// What the last replays took, ns.
    struct Times
    {
        std::array<double, kCompared> last{};
        std::uint32_t next = 0;

        void add(double nanoseconds);
        double least() const;
    };

    void end_trial();

    Way best_ = Way::shared;
    Way tried_ = Way::alone; ///< the first replays run alone: they tell what elements cost by themselves
    bool compares_ = false;  ///< whether both ways are known
    std::uint32_t trial_left_ = kTrial;
    std::uint32_t interval_ = kShortest;
    std::uint32_t until_trial_ = 0;
    double usual_ = 0; ///< ns: what a replay took after the last trial
    Times of_best_;
    Times of_tried_;
};

} // namespace taut::cpu
