// Class R4 from coarse to fine: a method's substeps are doubled until its own error is small enough.
//
// Based on: Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: the level follows from the error that is asked for, so that a rough bound has a cheap
//   reference; frames are added while all of them are good, or while a finer level brings nothing; else
//   levels are.
#include "taut/report/cost_self.hpp"

#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace taut::cost {
namespace {

constexpr std::uint32_t kCoarsest = 15, kFinest = 960; // substeps
constexpr double kFalls = 0.9; ///< of the error at half of the frames: below it more frames lower it
constexpr double kStuck = 0.8; ///< of the last difference: a finer level that leaves more brings too little
/// Low orders come with a large estimate, and no estimate is below the last difference.
constexpr RefineRule kRule{0.5, std::numeric_limits<double>::infinity(), 1, true};

struct Level
{
    std::uint32_t substeps;
    Trial trial;
    Motion motion;
};

class Ladder
{
public:
    Ladder(const CostInput& input, MethodKind method) : input_(input), best_{method, {}, {}, "", 0, 0}
    {
        next_ = std::max(kCoarsest, input.options.coarsest);
    }

    Refined climb(std::size_t frames)
    {
        std::size_t window = std::min(frames, kFewest);
        while (climbs())
        {
            run(window);
            judge(window);
            if (enough(input_) || (good_ >= window && window == frames))
                break;
            const bool longer = good_ >= window || falls_ || stuck_;
            if (window < frames && longer)
                window = std::min(frames, 2 * window);
            else
                levels_.erase(levels_.begin());
        }
        say(std::min(frames, kFewest));
        return std::move(best_);
    }

private:
    /// Until there are three levels again; false: there is none finer.
    bool climbs()
    {
        while (levels_.size() < 3 && next_ <= kFinest && !enough(input_))
            add();
        if (levels_.empty() && refusal_)
            throw Error(*refusal_);
        return levels_.size() == 3;
    }

    /// Explicit steps begin where they are stable.
    void add()
    {
        const std::uint32_t substeps = next_;
        next_ *= 2;
        try
        {
            Trial trial(input_.scene, double_device(input_), fine_settings(input_, best_.method, substeps));
            levels_.push_back(std::make_unique<Level>(Level{substeps, std::move(trial), {}}));
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::unstable_timestep)
                throw;
            refusal_ = error;
        }
    }

    void run(std::size_t window)
    {
        for (const auto& level : levels_)
        {
            const std::size_t before = level->motion.steps;
            level->trial.extend(level->motion, window, [this] { return enough(input_); });
            work_ += static_cast<double>((level->motion.steps - before) * level->substeps);
        }
    }

    /// Keeps what the last three levels say when it is good for more frames than what is there.
    void judge(std::size_t window)
    {
        std::size_t least = window;
        good_ = 0;
        falls_ = stuck_ = false;
        for (const auto& level : levels_)
        {
            if (!level->motion.reason.empty()) // an unsound run is part of no reference
                return;
            least = std::min(least, level->motion.steps);
        }
        const auto frames = [&](std::size_t l) {
            const auto first = levels_[l]->motion.frames.begin();
            return Frames(first, first + static_cast<std::ptrdiff_t>(least) + 1);
        };
        const Frames half = frames(1);
        Frames finest = frames(2);
        if (least == window)
            note_difference(trajectory_error(input_.weights, half, finest).value_or(0), window);
        Refinement found = refine(input_.weights, frames(0), half, finest, kRule);
        good_ = good_frames(found);
        falls_ = found.frames == window && found.errors[window] < kFalls * found.errors[window / 2];
        const auto rank = [&](const Refinement& r) { return std::pair(good_frames(r), r.frames); };
        if (rank(found) <= rank(best_.found))
            return;
        best_.found = std::move(found);
        best_.finest = std::move(finest);
        best_.substeps = levels_[2]->substeps;
    }

    void note_difference(double difference, std::size_t window)
    {
        stuck_ = window == window_ && difference > kStuck * difference_;
        difference_ = difference;
        window_ = window;
        compared_ = levels_[2]->substeps;
    }

    std::size_t good_frames(const Refinement& found) const
    {
        std::size_t good = found.frames;
        while (good > 0 && !(found.errors[good] <= input_.options.reference_error))
            --good;
        return good;
    }

    /// The reason where there are too few frames, and what a further level over those would take.
    void say(std::size_t fewest)
    {
        if (best_.found.frames >= fewest && best_.found.frames > 0)
            return;
        const std::uint32_t finest = levels_.empty() ? next_ / 2 : levels_.back()->substeps;
        const std::string converges =
            "halving the substep converges for " + std::to_string(best_.found.frames) + " frames only";
        best_.reason = converges + ", up to " + std::to_string(finest) + " substeps";
        if (window_ > 0)
            best_.reason += "; at " + std::to_string(compared_) + " it changes the motion by " +
                            shown_percent(difference_, 2) + " over " + std::to_string(window_) + " frames";
        if (!enough(input_))
            return;
        best_.reason += "; then the time for the reference was up";
        const double further = static_cast<double>(fewest) * 1.75 * 2 * finest; // n, n/2 and n/4 substeps
        best_.times = work_ > 0 ? 1 + further / work_ : 0;
    }

    const CostInput& input_;
    Refined best_;
    std::uint32_t next_;
    std::vector<std::unique_ptr<Level>> levels_; ///< the last three
    std::optional<Error> refusal_;
    std::size_t good_ = 0; ///< frames
    bool falls_ = false;   ///< the error falls along the frames: more of them may do instead of a finer level
    bool stuck_ = false;   ///< a finer level has brought hardly anything
    double difference_ = 0; ///< of the last two levels, over `window_` frames
    std::size_t window_ = 0;
    std::uint32_t compared_ = 0; ///< the finer one's substeps
    double work_ = 0;            ///< substeps
};

} // namespace

Refined climb(const CostInput& input, MethodKind method, std::size_t frames)
{
    return Ladder(input, method).climb(frames);
}

} // namespace taut::cost
