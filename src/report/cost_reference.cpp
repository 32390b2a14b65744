// Based on: Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: class R4, a refined run of the method under test, where no independent reference can be
//   had; it cannot see errors that all runs of the method share (docs/cost.md).
#include "taut/report/cost_reference.hpp"

#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace taut::cost {
namespace {

constexpr const char* kSelf = "R4 (self-convergence, same method)";
constexpr std::size_t kFirstWindow = 15, kFewest = 6;        // frames
constexpr std::array<std::uint32_t, 3> kFine{100, 200, 400}; // substeps

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

// ---------------------------------------------------------------- at rest

/// Where a fine run of the method comes to rest: only a second start for Newton.
Motion settled_run(const Question& q, std::uint32_t substeps)
{
    Trial trial(q.scene, double_device(q), {substeps, 1, Precision::float64});
    return trial.settle({q.weights, nullptr, q.options.rest_seconds});
}

/// Two solves from two starts: the scene's, and where the method itself comes to rest.
CostReference newton(const Question& q, std::string& refusal)
{
    CostReference out;
    const StaticReference solved = solve_static(q.model, q.model.start);
    if (!solved.converged || !solved.stable)
    {
        refusal = "R2: " + solved.reason;
        return out;
    }
    out.name = "R2";
    out.verified = true;
    out.frames = {q.model.start, solved.positions};
    out.text = "Newton in fp64 on the same mesh and energy, residual " + number(solved.relative_residual) +
               " of the weight";
    const Motion settled = settled_run(q, 20);
    const StaticReference second =
        settled.rests ? solve_static(q.model, settled.frames.back()) : StaticReference{};
    if (!second.converged)
    {
        out.text += "; not solved from a second start.";
        return out;
    }
    out.error = displacement_error(q.weights, second.positions, solved.positions, q.model.start);
    out.error_l = largest_error(q.weights, second.positions, solved.positions);
    if (out.error.value_or(0) < 1e-6)
    {
        out.text += "; a second solve from another start agrees.";
        return out;
    }
    // Several equilibria: the one next to where the method rests is what it approximates.
    out.frames[1] = second.positions;
    out.error = out.error_l = std::nullopt;
    out.text +=
        ". The scene has several equilibria: this is the one nearest to where the method comes to rest.";
    return out;
}

CostReference self_at_rest(const Question& q, std::vector<std::string> passed)
{
    std::array<Frames, 3> level;
    for (std::size_t l = 0; l < 3; ++l)
    {
        Motion settled = settled_run(q, kFine[l]);
        if (!settled.rests)
        {
            passed.push_back("R4: " + std::to_string(kFine[l]) + " substeps: " + settled.reason);
            return none(std::move(passed));
        }
        level[l] = std::move(settled.frames);
    }
    const Refinement found = refine(q.weights, level[0], level[1], level[2]);
    if (found.frames == 0)
    {
        passed.push_back("R4: halving the substep does not converge");
        return none(std::move(passed));
    }
    CostReference out{kSelf, "", std::move(passed), true, found.error, found.error_l, std::move(level[2])};
    out.text = "XPBD itself in double with 400 substeps x 1 iteration, halved twice, observed order " +
               number(found.order) + "; blind to errors that all its runs share.";
    return out;
}

// ---------------------------------------------------------------- moving

/// Frames of R3 that the budget allows, at most `frames`; too few come with a reason.
std::size_t affordable(const Question& q, std::size_t frames, DynamicOptions options, std::string& reason)
{
    const double budget = options.max_element_steps;
    options.duration = static_cast<double>(frames) * q.model.timestep;
    options.max_element_steps = 0; // refuses, but counts first
    DynamicReference dry = solve_dynamic(q.model, options);
    const double share = dry.element_steps > 0 ? std::min(1.0, budget / dry.element_steps) : 1;
    const auto most = static_cast<std::size_t>(share * static_cast<double>(frames));
    if (rigid_element_count(q.model) > 0)
        reason = dry.reason;
    else if (most < std::min(frames, kFewest))
        reason = "too stiff for explicit steps: " + std::to_string(frames) + " frames need " +
                 number(dry.element_steps) + " element steps, the budget is " + number(budget);
    return most;
}

/// Grows the window while every frame of it is verified: swinging cloth is chaotic, and a long run
/// past the last frame on which step sizes agree would be for nothing.
DynamicReference small_steps(const Question& q, std::size_t frames, std::string& stop)
{
    DynamicOptions options;
    options.safety = 0.5;
    options.max_element_steps = q.options.reference_steps;
    DynamicReference best;
    const std::size_t most = affordable(q, frames, options, best.reason);
    if (!best.reason.empty())
        return best;
    options.max_element_steps = std::numeric_limits<double>::infinity(); // the windows keep to it
    stop = most < frames ? "the budget of reference steps ends there" : "";
    for (std::size_t window = std::min(most, kFirstWindow);; window = std::min(most, 2 * window))
    {
        options.duration = static_cast<double>(window) * q.model.timestep;
        DynamicReference next = solve_dynamic(q.model, options);
        if (next.verified || next.verified_frames >= best.verified_frames)
            best = std::move(next);
        if (!best.verified)
            stop = "from there on step sizes disagree, the motion is chaotic";
        if (!best.verified || window == most)
            return best;
    }
}

/// Three runs side by side, longer and longer while they agree on every frame.
class SelfConvergence
{
public:
    explicit SelfConvergence(const Question& q) : q_(q)
    {
        for (const std::uint32_t substeps : kFine)
            trials_.emplace_back(q.scene, double_device(q), Setting{substeps, 1, Precision::float64});
    }

    Refinement run(std::size_t frames)
    {
        for (std::size_t window = std::min(frames, kFirstWindow);; window = std::min(frames, 2 * window))
        {
            std::size_t least = window;
            for (std::size_t l = 0; l < 3; ++l)
            {
                trials_[l].extend(motion_[l], window);
                least = std::min(least, motion_[l].frames.size() - 1);
            }
            const auto level = [&](std::size_t l) {
                const auto first = motion_[l].frames.begin();
                return Frames(first, first + static_cast<std::ptrdiff_t>(least) + 1);
            };
            const Refinement found = refine(q_.weights, level(0), level(1), level(2));
            if (found.frames < window || window == frames)
                return found;
        }
    }

    Frames& finest() { return motion_[2].frames; }

private:
    const Question& q_;
    std::vector<Trial> trials_;
    std::array<Motion, 3> motion_;
};

CostReference self_motion(const Question& q, std::size_t frames, std::vector<std::string> passed)
{
    SelfConvergence runs(q);
    const Refinement found = runs.run(frames);
    if (found.frames == 0 || found.frames < std::min(frames, kFewest))
    {
        passed.push_back("R4: halving the substep converges for " + std::to_string(found.frames) +
                         " frames only");
        return none(std::move(passed));
    }
    runs.finest().resize(found.frames + 1);
    CostReference out{
        kSelf, "", std::move(passed), true, found.error, found.error_l, std::move(runs.finest())};
    out.text = "XPBD itself in double with 400 substeps x 1 iteration, halved twice, observed order " +
               number(found.order) + ", over " + frames_text(found.frames, q.model.timestep) +
               "; blind to errors that all its runs share.";
    return out;
}

} // namespace

Refinement refine(const ErrorWeights& weights, const Frames& coarse, const Frames& half,
                  const Frames& quarter)
{
    double first = 0, last = 0, moved = 0; // sums of squares
    Refinement out;
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
        if (!good && out.frames > 0)
            break;
        if (!good)
            continue;
        const double share = exact ? 1 : 1 / (std::exp2(order) - 1);
        out = {f, exact ? 0 : order, difference * share, 0};
        out.error_l = weights.diameter > 0 ? share * largest_error(weights, half[f], quarter[f]) : 0;
    }
    return out;
}

std::size_t wanted_frames(const Scene& scene, const CostOptions& options)
{
    if (options.frames > 0)
        return options.frames;
    return static_cast<std::size_t>(std::max(0.0, std::ceil(scene.duration / scene.timestep - 1e-6)));
}

CostReference reference_at_rest(const Question& q)
{
    std::string refusal;
    CostReference out = newton(q, refusal);
    return out.verified ? out : self_at_rest(q, {refusal});
}

CostReference reference_of_motion(const Question& q)
{
    const std::size_t frames = wanted_frames(q.scene, q.options);
    std::string stop;
    DynamicReference found = small_steps(q, frames, stop);
    if (found.verified_frames == 0 || found.verified_frames < std::min(frames, kFewest))
        return self_motion(q, frames, {"R3: " + found.reason});
    found.frames.resize(found.verified_frames + 1);
    CostReference out{"R3", "", {}, true, found.error, found.largest_error, std::move(found.frames)};
    out.text = "Explicit small steps in fp64 (" + number(found.step) + " s), own error " +
               number(found.error) + " by halving, over " +
               frames_text(found.verified_frames, q.model.timestep);
    out.text += stop.empty() || found.verified_frames == frames ? "." : "; " + stop + ".";
    return out;
}

} // namespace taut::cost
