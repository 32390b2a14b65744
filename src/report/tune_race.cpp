// One candidate against one reference, with a harder bound on every longer rung.
// Based on: Jamieson, Talwalkar, Non-stochastic Best Arm Identification and Hyperparameter Optimization,
//   2016 (successive halving: short runs sort out most).
// Departures: candidates come in the order of their price, and the first that passes ends the race.
#include "taut/report/cost_self.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/report/volume.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut::tuning {

using cost::Motion;

namespace {

constexpr std::size_t kRungs[] = {18, 48};
constexpr double kSlack[] = {1, 2, 3}; ///< counted from the last rung

double volume_error(const Scene& scene, const Frames& frames)
{
    double worst = 0;
    for (const auto& x : frames)
        worst = std::max(worst, std::abs(measure_volume(scene, x).ratio - 1));
    return worst;
}

double error_of(const Start& start, const Frames& frames)
{
    if (start.metric == "e_V")
        return volume_error(start.scene, frames);
    const Frames& all = start.reference.frames;
    const bool at_rest = start.metric == "e_disp";
    if (start.metric == "e_L")
        return start.weights.diameter > 0
                   ? largest_error(start.weights, frames.back(), all[std::min(frames.size(), all.size()) - 1])
                   : 0;
    if (at_rest)
        return *displacement_error(start.weights, frames.back(), all.back(), all.front());
    const Frames reference(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(frames.size()));
    return trajectory_error(start.weights, frames, reference).value_or(0);
}

std::vector<std::size_t> rungs(std::size_t last)
{
    std::vector<std::size_t> out;
    for (const std::size_t rung : kRungs)
        if (rung < last)
            out.push_back(rung);
    out.push_back(last);
    return out;
}

/// Fills `run` and says whether the rung is passed.
bool passes(const Start& start, const Motion& motion, double bound, TrialRun& run)
{
    if (!motion.reason.empty())
    {
        run.error.reset(); // that of a rung before says nothing of this one
        run.reason = motion.reason;
        return false;
    }
    run.error = error_of(start, motion.frames);
    if (*run.error <= bound)
        return true;
    run.reason = "error " + shown_percent(*run.error) + " is above " + shown_percent(bound);
    if (run.frames > 0)
        run.reason += " after " + std::to_string(run.frames) + " frames";
    return false;
}

} // namespace

Start make_start(const Scene& resolved, const std::shared_ptr<Device>& device, CostKind kind,
                 const CostOptions& options)
{
    Start out{resolved, make_model(resolved), {}, {}, {}, 0};
    out.weights = error_weights(out.model);
    const cost::CostInput input{out.scene, out.model, out.weights, options, device};
    const bool at_rest = kind == CostKind::at_rest;
    out.reference = at_rest ? cost::reference_at_rest(input) : cost::reference_of_motion(input);
    const auto& frames = out.reference.frames;
    const bool moves = std::any_of(frames.begin(), frames.end(), [&](const auto& x) {
        return distance_by_mass(out.weights, x, frames[0]) > 0;
    });
    out.metric = !moves ? "e_L" : at_rest ? "e_disp" : "e_traj";
    out.frames = at_rest || frames.empty() ? 0 : frames.size() - 1;
    return out;
}

namespace {

/// Nothing has moved by then but for rounding: no error can be told.
bool still(const Start& start, std::size_t frame)
{
    const Frames& all = start.reference.frames;
    return start.weights.diameter > 0 && largest_error(start.weights, all[frame], all[0]) < 1e-9;
}

} // namespace

std::pair<TuneAnswer, std::string> refusal(const Start& start, bool fits, const TuneResult& result,
                                           const TuneOptions& options)
{
    if (!start.reference.verified)
        return {TuneAnswer::no_reference, no_reference(result, options)};
    if (!fits)
        return {TuneAnswer::poor_reference, poor_reference(result)};
    const bool ends = !start.reference.frames.empty(); // a reference of volumes has no frames
    const std::uint64_t inverted =
        ends ? measure_volume(start.scene, start.reference.frames.back()).inverted : 0;
    if (inverted > start.scene.accept.inverted)
        return {TuneAnswer::unsound_reference, unsound_reference(inverted, start.scene.accept)};
    return {result.answer, ""};
}

Scene damped_to_rest(const Scene& resolved)
{
    Scene out = resolved;
    const bool remembers = !resolved.colliders.empty() ||
                           std::any_of(out.bodies.begin(), out.bodies.end(), [](const Body& body) {
                               return body.material.tear_strain > 0 || body.material.plastic_yield > 0;
                           });
    const double size = make_model(resolved).diameter;
    if (!remembers && size > 0)
        out.damping = std::max(out.damping, 2 * std::sqrt(glm::length(out.gravity) / size));
    return out;
}

bool fit_reference(Start& start, double bound)
{
    CostReference& reference = start.reference;
    const double most = kReferenceShare * bound;
    if (reference.error.value_or(0) <= most)
        return true;
    if (start.frames == 0 || start.metric == "e_L" || reference.errors.size() != reference.frames.size())
        return false;
    std::size_t good = start.frames;
    while (good > 0 && !(reference.errors[good] <= most))
        --good;
    if (good < std::min(start.frames, cost::kFewest) || (still(start, good) && !still(start, start.frames)))
        return false;
    reference.error = reference.errors[good];
    reference.frames.resize(good + 1);
    reference.errors.resize(good + 1);
    start.frames = good;
    return true;
}

Start make_volume_start(const Scene& resolved, std::size_t frames)
{
    Start out{resolved, make_model(resolved), {}, {}, "e_V", frames};
    out.weights = error_weights(out.model);
    out.reference.name = "rest volume";
    out.reference.text = "The volume of each body at rest. Of how it moves nothing is asked.";
    out.reference.verified = true;
    out.reference.error = out.reference.error_l = 0;
    return out;
}

TrialRun run_trial(const Start& start, const std::shared_ptr<Device>& device, const MethodSettings& settings,
                   CostKind kind, double bound, double rest_seconds, const std::function<bool()>& enough)
{
    TrialRun out;
    cost::Trial trial(start.scene, device, settings);
    if (kind == CostKind::at_rest)
    {
        const Motion motion =
            trial.settle({start.weights, &start.reference.frames.back(), rest_seconds, false, enough});
        out.cut = !motion.rests && enough && enough();
        passes(start, motion, bound, out);
        return out;
    }
    Motion motion;
    const std::vector<std::size_t> all = rungs(start.frames);
    for (std::size_t r = 0; r < all.size(); ++r)
    {
        // The worst of all frames only grows: it needs no slack.
        const double slack = start.metric == "e_V" ? 1 : kSlack[all.size() - 1 - r];
        out.frames = all[r];
        trial.extend(motion, all[r], enough);
        out.cut = motion.reason.empty() && motion.steps < all[r];
        if (out.cut)
            break;
        if (!passes(start, motion, slack * bound, out))
            break;
    }
    return out;
}

} // namespace taut::tuning
