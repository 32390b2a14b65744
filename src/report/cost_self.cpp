// Class R4: a method refined until it agrees with itself.
// Based on: Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: a reference that shares code with what it judges; with several methods it is the most accurate
//   one, and what the next one differs from it counts as its error (docs/cost.md).
#include "taut/report/cost_self.hpp"

#include "taut/report/method_settings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace taut::cost {
namespace {

constexpr const char* kSelf = "R4 (self-convergence, same method)";
constexpr std::array<std::uint32_t, 3> kFine{100, 200, 400}; // substeps

/// The device itself, or the native CPU where that one has no double.
std::shared_ptr<Device> double_device(const Question& q)
{
    return q.device->limits().float64 ? q.device : Device::open("cpu");
}

CostReference none(std::vector<std::string> passed)
{
    CostReference out;
    out.text = "There is no reference that can be trusted.";
    out.passed = std::move(passed);
    return out;
}

MethodSettings fine_settings(const Question& q, MethodKind method, std::uint32_t substeps)
{
    MethodSettings out = settings_for(method, q.scene.method);
    out.substeps = substeps;
    out.iterations = 1;
    out.precision = "double";
    out.stability = "refuse";
    return out;
}

/// A method refined until it agrees with itself; `reason` says when it does not.
struct Refined
{
    MethodKind method;
    Refinement found;
    Frames finest; ///< `found.frames` of them are good
    std::string reason;
};

/// The methods that may serve as R4: with one under test that one, else implicit and explicit ones before
/// those that only approach the stiffness by sweeps.
std::vector<MethodKind> candidates(const Question& q)
{
    if (!q.options.refined.empty())
        return q.options.refined;
    if (q.options.methods.size() == 1)
        return q.options.methods;
    return {MethodKind::implicit_euler, MethodKind::mass_spring, MethodKind::implicit_constraints,
            MethodKind::vbd, MethodKind::xpbd};
}

/// Those that converge; the others are listed in `passed`.
template <class Refine>
std::vector<Refined> refined(const Question& q, Refine refine_one, std::vector<std::string>& passed)
{
    std::vector<Refined> out;
    const std::vector<MethodKind> methods = candidates(q);
    for (std::size_t m = 0; m < methods.size(); ++m)
    {
        const MethodKind method = methods[m];
        CostOptions options = q.options;
        if (q.options.enough) // each has its share of the time, and what those before it left
            options.enough = [&](double part) {
                return q.options.enough((static_cast<double>(m) + part) /
                                        static_cast<double>(methods.size()));
            };
        const Question mine{q.scene, q.model, q.weights, options, q.device};
        std::string reason;
        try
        {
            if (enough(mine))
                throw Error(ErrorCode::limit, "the time for the reference was up");
            Refined next = refine_one(mine, method);
            reason = next.reason;
            if (reason.empty())
                out.push_back(std::move(next));
        }
        catch (const Error& error) // what a method refuses, another may do
        {
            reason = error.what();
        }
        if (!reason.empty())
            passed.push_back("R4 (" + std::string(method_name(method)) + "): " + reason);
    }
    return out;
}

/// How far two finest runs lie apart, as e_traj and e_L, over the frames that both have. `errors`, of the
/// frames up to each, are raised to it.
std::pair<double, double> apart(const Question& q, const Refined& a, const Refined& b,
                                std::vector<double>& errors)
{
    const std::size_t frames = std::min(a.found.frames, b.found.frames);
    errors.resize(frames + 1, 0);
    double off = 0, moved = 0, error = 0;
    for (std::size_t f = 1; f <= frames; ++f)
    {
        off += std::pow(distance_by_mass(q.weights, a.finest[f], b.finest[f]), 2);
        moved += std::pow(distance_by_mass(q.weights, a.finest[f], a.finest[0]), 2);
        error = moved > 0 ? std::sqrt(off / moved) : 0;
        errors[f] = std::max(errors[f], error);
    }
    const bool sized = q.weights.diameter > 0;
    return {error, sized ? largest_error(q.weights, a.finest[frames], b.finest[frames]) : 0};
}

/// The one with the longest good stretch, then the smallest error of its own, and how far the next one is
/// from it.
CostReference best_of(const Question& q, std::vector<Refined> runs, std::vector<std::string> passed)
{
    if (runs.empty())
        return none(std::move(passed));
    std::stable_sort(runs.begin(), runs.end(), [](const Refined& a, const Refined& b) {
        return a.found.frames != b.found.frames ? a.found.frames > b.found.frames
                                                : a.found.error < b.found.error;
    });
    Refined& best = runs[0];
    const std::string name(method_name(best.method));
    CostReference out;
    out.passed = std::move(passed);
    out.verified = true;
    out.error = best.found.error;
    out.error_l = best.found.error_l;
    const bool alone = q.options.methods.size() == 1;
    out.errors = best.found.errors;
    out.methods = {best.method};
    out.name = alone ? kSelf : "R4 (self-convergence of " + name + ")";
    out.text = name + (alone ? " itself" : "") + " in double with " + std::to_string(kFine[2]) +
               " substeps x 1 iteration, halved twice, observed order " + number(best.found.order);
    if (runs.size() > 1)
    {
        const auto [error, far] = apart(q, best, runs[1], out.errors);
        out.error = std::max(*out.error, error);
        out.error_l = std::max(*out.error_l, far);
        best.found.frames = std::min(best.found.frames, runs[1].found.frames);
        out.methods.push_back(runs[1].method);
        out.text += "; the finest run of " + std::string(method_name(runs[1].method)) + " differs by " +
                    number(error) + ", which counts as its error";
    }
    else
        out.text += "; blind to errors that all its runs share" +
                    std::string(alone ? "" : ", and no other method confirms it: it favours " + name);
    best.finest.resize(best.found.frames + 1);
    out.frames = std::move(best.finest);
    return out;
}

Refined refined_at_rest(const Question& q, MethodKind method)
{
    Refined out{method, {}, {}, ""};
    std::array<Frames, 3> level;
    for (std::size_t l = 0; l < 3; ++l)
    {
        Motion settled = settled_run(q, method, kFine[l]);
        if (!settled.rests)
        {
            out.reason = std::to_string(kFine[l]) + " substeps: " + settled.reason;
            return out;
        }
        level[l] = std::move(settled.frames);
    }
    out.found = refine(q.weights, level[0], level[1], level[2]);
    if (out.found.frames == 0)
        out.reason = "halving the substep does not converge";
    out.finest = std::move(level[2]);
    return out;
}

/// Three runs side by side, longer and longer while they agree on every frame.
class SelfConvergence
{
public:
    SelfConvergence(const Question& q, MethodKind method) : q_(q)
    {
        for (const std::uint32_t substeps : kFine)
            trials_.emplace_back(q.scene, double_device(q), fine_settings(q, method, substeps));
    }

    Refinement run(std::size_t frames)
    {
        for (std::size_t window = std::min(frames, kFirstWindow);; window = std::min(frames, 2 * window))
        {
            std::size_t least = window;
            for (std::size_t l = 0; l < 3; ++l)
            {
                trials_[l].extend(motion_[l], window, [this] { return enough(q_); });
                least = std::min(least, motion_[l].frames.size() - 1);
            }
            const auto level = [&](std::size_t l) {
                const auto first = motion_[l].frames.begin();
                return Frames(first, first + static_cast<std::ptrdiff_t>(least) + 1);
            };
            const Refinement found = refine(q_.weights, level(0), level(1), level(2));
            if (found.frames < window || window == frames || enough(q_))
                return found;
        }
    }

    Frames& finest() { return motion_[2].frames; }

private:
    const Question& q_;
    std::vector<Trial> trials_;
    std::array<Motion, 3> motion_;
};

} // namespace

std::string number(double value)
{
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(2);
    out << value;
    return out.str();
}

std::string frames_text(std::size_t frames, double timestep)
{
    return std::to_string(frames) + " frames (" + number(static_cast<double>(frames) * timestep) + " s)";
}

Motion settled_run(const Question& q, MethodKind method, std::uint32_t substeps)
{
    Trial trial(q.scene, double_device(q), fine_settings(q, method, substeps));
    return trial.settle({q.weights, nullptr, q.options.rest_seconds, false, [&q] { return enough(q); }});
}

CostReference self_at_rest(const Question& q, std::vector<std::string> passed)
{
    if (!q.options.self_reference)
        return none(std::move(passed));
    std::vector<Refined> runs = refined(q, refined_at_rest, passed);
    CostReference out = best_of(q, std::move(runs), std::move(passed));
    if (out.verified)
        out.text += ".";
    return out;
}

CostReference self_motion(const Question& q, std::size_t frames, std::vector<std::string> passed)
{
    if (!q.options.self_reference)
        return none(std::move(passed));
    const auto one = [frames](const Question& question, MethodKind method) {
        SelfConvergence runs(question, method);
        Refined out{method, runs.run(frames), std::move(runs.finest()), ""};
        if (out.found.frames == 0 || out.found.frames < std::min(frames, kFewest))
            out.reason =
                "halving the substep converges for " + std::to_string(out.found.frames) + " frames only";
        return out;
    };
    std::vector<Refined> runs = refined(q, one, passed);
    CostReference out = best_of(q, std::move(runs), std::move(passed));
    if (out.verified)
        out.text += "; over " + frames_text(out.frames.size() - 1, q.model.timestep) + ".";
    return out;
}

Refinement refine(const ErrorWeights& weights, const Frames& coarse, const Frames& half,
                  const Frames& quarter)
{
    double first = 0, last = 0, moved = 0; // sums of squares
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
        const double difference = moved > 0 ? std::sqrt(last / moved) : 0;
        const bool exact = !(difference > 1e-12);
        const bool good = exact || (order >= 0.7 && order <= 2.3 && difference < 0.05);
        const double share = exact ? 1 : 1 / (std::exp2(order) - 1);
        errors.push_back(good ? difference * share : std::numeric_limits<double>::infinity());
        if (!good && out.frames > 0)
            break;
        if (!good)
            continue;
        out = {f, exact ? 0 : order, difference * share, 0, {}};
        out.error_l = weights.diameter > 0 ? share * largest_error(weights, half[f], quarter[f]) : 0;
    }
    errors.resize(out.frames + 1);
    out.errors = std::move(errors);
    return out;
}

} // namespace taut::cost
