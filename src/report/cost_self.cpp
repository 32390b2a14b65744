// Class R4: a method refined until it agrees with itself.
// Based on: Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: a reference that shares code with what it judges; with several methods it is the most accurate
//   one, and what the next one differs from it counts as its error (docs/cost.md).
#include "taut/report/cost_self.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut::cost {
namespace {

constexpr const char* kSelf = "R4 (self-convergence, same method)";
constexpr std::array<std::uint32_t, 3> kFine{100, 200, 400}; // substeps

CostReference no_reference(std::vector<std::string> passed)
{
    CostReference out;
    out.text = "There is no reference that can be trusted.";
    out.passed = std::move(passed);
    return out;
}

/// The methods that may serve as R4: with one under test that one, else implicit and explicit ones before
/// those that only approach the stiffness by sweeps.
std::vector<MethodKind> candidates(const CostInput& input)
{
    if (!input.options.refined.empty())
        return input.options.refined;
    if (input.options.methods.size() == 1)
        return input.options.methods;
    if (input.options.reference_error > 0) // two will do: the cheapest steps first
        return {MethodKind::xpbd, MethodKind::mass_spring, MethodKind::vbd, MethodKind::implicit_euler,
                MethodKind::implicit_constraints};
    return {MethodKind::implicit_euler, MethodKind::mass_spring, MethodKind::implicit_constraints,
            MethodKind::vbd, MethodKind::xpbd};
}

constexpr std::size_t kInARow = 3;   ///< frames that converge after some that did not
constexpr double kFirstShare = 0.65; ///< of the time that is left, for one of two methods

/// Options under which so large a share of the time that is left counts as all.
CostOptions with_share(const CostOptions& options, double share)
{
    CostOptions out = options;
    if (!options.spent)
        return out;
    const double begun = options.spent(), mine = share * (1 - begun);
    out.spent = [spent = options.spent, begun, mine] { return mine > 0 ? (spent() - begun) / mine : 1; };
    return out;
}

/// Those that converge; the others are listed in `passed`. Each has its share of the time, and what those
/// before it left; of a reference that is no finer than it must be two are enough.
template <class Refine>
std::vector<Refined> refined(const CostInput& input, Refine refine_one, CostReference& none)
{
    std::vector<Refined> out;
    const std::vector<MethodKind> methods = candidates(input);
    const bool two = input.options.reference_error > 0;
    for (std::size_t m = 0; m < methods.size() && !(two && out.size() == 2); ++m)
    {
        const MethodKind method = methods[m];
        const double share = two ? kFirstShare : 1 / static_cast<double>(methods.size() - m);
        const CostOptions options = with_share(input.options, share);
        const CostInput mine{input.scene, input.model, input.weights, options, input.device};
        std::string reason;
        try
        {
            if (enough(mine))
                throw Error(ErrorCode::limit, "the time for the reference was up");
            Refined next = refine_one(mine, method);
            reason = next.reason;
            if (next.times > 0)
                none.times = none.times > 0 ? std::min(none.times, next.times) : next.times;
            if (reason.empty())
                out.push_back(std::move(next));
        }
        catch (const Error& error) // what a method refuses, another may do
        {
            reason = error.what();
        }
        if (!reason.empty())
            none.passed.push_back("R4 (" + std::string(to_string(method)) + "): " + reason);
    }
    return out;
}

/// Of a frame, squared: what differs by less does not differ.
double rounding_of(const ErrorWeights& weights)
{
    const double mass = std::accumulate(weights.mass.begin(), weights.mass.end(), 0.0);
    return 1e-28 * mass * weights.diameter * weights.diameter;
}

/// How far two finest runs lie apart, as e_traj and e_L, over the frames that both have. `errors`, of the
/// frames up to each, are raised to it.
std::pair<double, double> apart(const CostInput& input, const Refined& a, const Refined& b,
                                std::vector<double>& errors)
{
    const std::size_t frames = std::min(a.found.frames, b.found.frames);
    errors.resize(frames + 1, 0);
    const double rounding = rounding_of(input.weights);
    double off = 0, moved = 0, error = 0;
    for (std::size_t f = 1; f <= frames; ++f)
    {
        off += std::pow(distance_by_mass(input.weights, a.finest[f], b.finest[f]), 2);
        moved += std::pow(distance_by_mass(input.weights, a.finest[f], a.finest[0]), 2);
        error = off > rounding * static_cast<double>(f) ? std::sqrt(off / moved) : 0;
        errors[f] = std::max(errors[f], error);
    }
    const bool sized = input.weights.diameter > 0;
    return {error, sized ? largest_error(input.weights, a.finest[frames], b.finest[frames]) : 0};
}

/// The one with the longest good stretch, then the smallest error of its own, and how far the next one is
/// from it.
CostReference best_of(const CostInput& input, std::vector<Refined> runs, CostReference none)
{
    if (runs.empty())
        return none;
    std::stable_sort(runs.begin(), runs.end(), [](const Refined& a, const Refined& b) {
        return a.found.frames != b.found.frames ? a.found.frames > b.found.frames
                                                : a.found.error < b.found.error;
    });
    if (input.options.reference_error > 0 && runs.size() > 1 &&
        2 * runs[1].found.frames < runs[0].found.frames)
        runs.erase(runs.begin() + 1, runs.end()); // half of the frames are worth more than a second opinion
    Refined& best = runs[0];
    const std::string name(to_string(best.method));
    CostReference out;
    out.passed = std::move(none.passed);
    out.verified = true;
    out.substeps = best.substeps;
    out.error = best.found.error;
    out.error_l = best.found.error_l;
    const bool alone = input.options.methods.size() == 1;
    out.errors = best.found.errors;
    out.methods = {best.method};
    out.name = alone ? kSelf : "R4 (self-convergence of " + name + ")";
    out.text = name + (alone ? " itself" : "") + " in double with " + std::to_string(best.substeps) +
               " substeps x 1 iteration, halved twice, observed order " + shown(best.found.order, 2);
    if (runs.size() > 1)
    {
        const auto [error, far] = apart(input, best, runs[1], out.errors);
        out.error = std::max(*out.error, error);
        out.error_l = std::max(*out.error_l, far);
        best.found.frames = std::min(best.found.frames, runs[1].found.frames);
        out.methods.push_back(runs[1].method);
        out.text += "; the finest run of " + std::string(to_string(runs[1].method)) + " differs by " +
                    shown(error, 2) + ", which counts as its error";
    }
    else
        out.text += "; blind to errors that all its runs share" +
                    std::string(alone ? "" : ", and no other method confirms it: it favours " + name);
    best.finest.resize(best.found.frames + 1);
    out.frames = std::move(best.finest);
    return out;
}

Refined refined_at_rest(const CostInput& input, MethodKind method)
{
    Refined out{method, {}, {}, "", kFine[2]};
    std::array<Frames, 3> level;
    for (std::size_t l = 0; l < 3; ++l)
    {
        Motion settled = settled_run(input, method, kFine[l]);
        if (!settled.rests)
        {
            out.reason = std::to_string(kFine[l]) + " substeps: " + settled.reason;
            return out;
        }
        level[l] = std::move(settled.frames);
    }
    out.found = refine(input.weights, level[0], level[1], level[2]);
    if (out.found.frames == 0)
        out.reason = "halving the substep does not converge";
    out.finest = std::move(level[2]);
    return out;
}

/// Three runs side by side, longer and longer while they agree on every frame.
class SelfConvergence
{
public:
    SelfConvergence(const CostInput& input, MethodKind method) : input_(input)
    {
        for (const std::uint32_t substeps : kFine)
            trials_.emplace_back(input.scene, double_device(input), fine_settings(input, method, substeps));
    }

    Refinement run(std::size_t frames)
    {
        for (std::size_t window = std::min(frames, kFirstWindow);; window = std::min(frames, 2 * window))
        {
            std::size_t least = window;
            for (std::size_t l = 0; l < 3; ++l)
            {
                trials_[l].extend(motion_[l], window, [this] { return enough(input_); });
                least = std::min(least, motion_[l].frames.size() - 1);
            }
            const auto level = [&](std::size_t l) {
                const auto first = motion_[l].frames.begin();
                return Frames(first, first + static_cast<std::ptrdiff_t>(least) + 1);
            };
            RefineRule rule;
            rule.rejoins = wants_contact(input_.scene); // surfaces land in other substeps of each level
            const Refinement found = refine(input_.weights, level(0), level(1), level(2), rule);
            if (found.frames < window || window == frames || enough(input_))
                return found;
        }
    }

    Frames& finest() { return motion_[2].frames; }

private:
    const CostInput& input_;
    std::vector<Trial> trials_;
    std::array<Motion, 3> motion_;
};

} // namespace

std::shared_ptr<Device> double_device(const CostInput& input)
{
    return input.device->limits().float64 ? input.device : Device::open("cpu");
}

MethodSettings fine_settings(const CostInput& input, MethodKind method, std::uint32_t substeps)
{
    MethodSettings out = settings_for(method, input.scene.method);
    out.substeps = substeps;
    out.iterations = 1;
    out.precision = Precision::float64;
    out.stability = StabilityRule::refuse;
    return out;
}

std::string frames_text(std::size_t frames, double timestep)
{
    return std::to_string(frames) + " frames (" + shown(static_cast<double>(frames) * timestep, 2) + " s)";
}

Motion settled_run(const CostInput& input, MethodKind method, std::uint32_t substeps)
{
    Trial trial(input.scene, double_device(input), fine_settings(input, method, substeps));
    return trial.settle(
        {input.weights, nullptr, input.options.rest_seconds, false, [&input] { return enough(input); }});
}

CostReference self_at_rest(const CostInput& input, std::vector<std::string> passed)
{
    CostReference none = no_reference(std::move(passed));
    if (!input.options.self_reference)
        return none;
    std::vector<Refined> runs = refined(input, refined_at_rest, none);
    CostReference out = best_of(input, std::move(runs), std::move(none));
    if (out.verified)
        out.text += ".";
    return out;
}

CostReference self_motion(const CostInput& input, std::size_t frames, std::vector<std::string> passed)
{
    CostReference none = no_reference(std::move(passed));
    if (!input.options.self_reference)
        return none;
    const auto one = [frames](const CostInput& mine, MethodKind method) {
        if (mine.options.reference_error > 0)
            return climb(mine, method, frames);
        SelfConvergence runs(mine, method);
        Refined out{method, runs.run(frames), std::move(runs.finest()), "", kFine[2]};
        if (out.found.frames == 0 || out.found.frames < std::min(frames, kFewest))
            out.reason =
                "halving the substep converges for " + std::to_string(out.found.frames) + " frames only";
        return out;
    };
    std::vector<Refined> runs = refined(input, one, none);
    CostReference out = best_of(input, std::move(runs), std::move(none));
    if (out.verified)
        out.text += "; over " + frames_text(out.frames.size() - 1, input.model.timestep) + ".";
    return out;
}

Refinement refine(const ErrorWeights& weights, const Frames& coarse, const Frames& half,
                  const Frames& quarter, const RefineRule& rule)
{
    const double rounding = rounding_of(weights);
    double first = 0, last = 0, moved = 0; // sums of squares
    std::size_t in_a_row = 0;
    Refinement out;
    std::vector<double> errors(1, 0);
    const auto squared = [&](const auto& a, const auto& b) {
        const double d = distance_by_mass(weights, a, b);
        return d * d;
    };
    for (std::size_t f = 1; f < quarter.size(); ++f)
    {
        first += squared(coarse[f], half[f]);
        last += squared(half[f], quarter[f]);
        moved += squared(quarter[f], quarter[0]);
        const double order = 0.5 * std::log2(first / last);
        const bool still = last <= rounding * static_cast<double>(f);
        const double difference = moved > 0 && !still ? std::sqrt(last / moved) : 0;
        const bool exact = !(difference > 1e-12);
        const bool good = exact || (order >= rule.lowest && order <= rule.highest && difference < 0.05);
        const double share = exact ? 1 : std::max(rule.share, 1 / (std::exp2(order) - 1));
        errors.push_back(good ? difference * share : std::numeric_limits<double>::infinity());
        if (!good && out.frames > 0 && !rule.rejoins)
            break;
        in_a_row = good ? in_a_row + 1 : 0;
        if (!good || (rule.rejoins && in_a_row < std::min(f, kInARow)))
            continue;
        out = {f, exact ? 0 : order, difference * share, 0, {}};
        out.error_l = weights.diameter > 0 ? share * largest_error(weights, half[f], quarter[f]) : 0;
    }
    errors.resize(out.frames + 1);
    out.errors = std::move(errors);
    return out;
}

} // namespace taut::cost
