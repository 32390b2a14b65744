// Based on: Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: class R4 (cost_self.cpp) where no independent reference can be had.
#include "taut/report/cost_reference.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/report/cost_self.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::cost {

std::string unmodelled(const Scene& scene)
{
    const auto any = [&](auto has) {
        return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                           [&](const Body& body) { return has(body.material); });
    };
    std::string out;
    const auto add = [&](bool there, const char* what) {
        if (there)
            out += std::string(out.empty() ? "it does not model " : ", ") + what;
    };
    add(scene.wind.density > 0 && any([](const Material& m) { return m.drag > 0 || m.friction_drag > 0; }),
        "wind");
    add(any([](const Material& m) { return m.strain_limit > 0; }), "limits of strain");
    add(any([](const Material& m) { return m.attachment_slack.has_value(); }), "attachments");
    add(any([](const Material& m) { return m.tear_strain > 0; }), "tearing");
    add(any([](const Material& m) { return m.plastic_yield > 0; }), "plasticity");
    add(wants_contact(scene), "contact between surfaces");
    add(std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) { return b.kinematic.used; }),
        "kinematic bodies");
    return out;
}

namespace {

// ---------------------------------------------------------------- at rest

/// Two solves from two starts: the scene's, and where the method itself comes to rest.
CostReference newton(const CostInput& input, std::string& refusal)
{
    CostReference out;
    const StaticReference solved = solve_static(input.model, input.model.start);
    if (!solved.converged || !solved.stable)
    {
        refusal = "R2: " + solved.reason;
        return out;
    }
    out.name = "R2";
    out.verified = true;
    out.frames = {input.model.start, solved.positions};
    out.text = "Newton in fp64 on the same mesh and energy, residual " + shown(solved.relative_residual, 2) +
               " of the weight";
    if (solved.correction > 0)
        out.text += " (rounding of its forces; a further step moves " + shown(solved.correction, 2) + " m)";
    const Motion settled = settled_run(input, MethodKind::xpbd, 20); // only a second start for Newton
    const StaticReference second =
        settled.rests ? solve_static(input.model, settled.frames.back()) : StaticReference{};
    if (!second.converged)
    {
        out.text += "; not solved from a second start.";
        return out;
    }
    out.error = displacement_error(input.weights, second.positions, solved.positions, input.model.start);
    out.error_l = largest_error(input.weights, second.positions, solved.positions);
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

// ---------------------------------------------------------------- moving

/// Frames of R3 that the budget allows, at most `frames`; too few come with a reason.
std::size_t affordable(const CostInput& input, std::size_t frames, DynamicOptions options,
                       std::string& reason)
{
    const double budget = options.max_element_steps;
    options.duration = static_cast<double>(frames) * input.model.timestep;
    options.max_element_steps = 0; // refuses, but counts first
    DynamicReference dry = solve_dynamic(input.model, options);
    const double share = dry.element_steps > 0 ? std::min(1.0, budget / dry.element_steps) : 1;
    const auto most = static_cast<std::size_t>(share * static_cast<double>(frames));
    if (rigid_element_count(input.model) > 0)
        reason = dry.reason;
    else if (most < std::min(frames, kFewest))
        reason = "too stiff for explicit steps: " + std::to_string(frames) + " frames need " +
                 shown(dry.element_steps, 2) + " element steps, the budget is " + shown(budget, 2);
    return most;
}

/// Grows the window while every frame of it is verified: swinging cloth is chaotic, and a long run
/// past the last frame on which step sizes agree would be for nothing.
DynamicReference small_steps(const CostInput& input, std::size_t frames, std::string& stop)
{
    DynamicOptions options;
    options.safety = 0.5;
    options.max_element_steps = input.options.reference_steps;
    DynamicReference best;
    const std::size_t most = affordable(input, frames, options, best.reason);
    if (!best.reason.empty())
        return best;
    options.max_element_steps = std::numeric_limits<double>::infinity(); // the windows keep to it
    stop = most < frames ? "the budget of reference steps ends there" : "";
    for (std::size_t window = std::min(most, kFirstWindow);; window = std::min(most, 2 * window))
    {
        options.duration = static_cast<double>(window) * input.model.timestep;
        DynamicReference next = solve_dynamic(input.model, options);
        if (next.verified || next.verified_frames >= best.verified_frames)
            best = std::move(next);
        if (!best.verified)
            stop = "from there on step sizes disagree, the motion is chaotic";
        if (best.verified && window < most && enough(input))
            stop = "the time for the reference ends there";
        if (!best.verified || window == most || enough(input))
            return best;
    }
}

} // namespace

bool enough(const CostInput& input) { return input.options.spent && input.options.spent() >= 1; }

std::size_t wanted_frames(const Scene& scene, const CostOptions& options)
{
    if (options.frames > 0)
        return options.frames;
    return static_cast<std::size_t>(std::max(0.0, std::ceil(scene.duration / scene.timestep - 1e-6)));
}

CostReference reference_at_rest(const CostInput& input)
{
    std::string refusal = unmodelled(input.scene);
    if (!refusal.empty())
        return self_at_rest(input, {"R2: " + refusal});
    CostReference out = newton(input, refusal);
    return out.verified ? out : self_at_rest(input, {refusal});
}

CostReference reference_of_motion(const CostInput& input)
{
    const std::size_t frames = wanted_frames(input.scene, input.options);
    std::string refusal = unmodelled(input.scene);
    if (refusal.empty() && std::any_of(input.model.springs.begin(), input.model.springs.end(),
                                       [](const StretchElement& e) { return e.damping > 0; }))
        refusal = "it does not model the dampers of springs";
    if (!refusal.empty())
        return self_motion(input, frames, {"R3: " + refusal});
    std::string stop;
    DynamicReference found = small_steps(input, frames, stop);
    if (found.verified_frames == 0 || found.verified_frames < std::min(frames, kFewest))
        return self_motion(input, frames, {"R3: " + found.reason});
    found.frames.resize(found.verified_frames + 1);
    CostReference out;
    out.name = "R3";
    out.verified = true;
    out.error = found.error;
    out.error_l = found.largest_error;
    out.errors = std::move(found.errors);
    out.errors.resize(found.verified_frames + 1);
    out.frames = std::move(found.frames);
    out.text = "Explicit small steps in fp64 (" + shown(found.step, 2) + " s), own error " +
               shown(found.error, 2) + " by halving, over " +
               frames_text(found.verified_frames, input.model.timestep);
    out.text += stop.empty() || found.verified_frames == frames ? "." : "; " + stop + ".";
    return out;
}

} // namespace taut::cost
