// What can be said of a setting without simulating: that it cannot work, and about what it costs.
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <limits>

namespace taut::tuning {
namespace {

/// Bytes that one distance constraint moves in float: its record, and two vertices read and written.
constexpr double kElementBytes = 112;

std::string number(double value)
{
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr;
    return std::string(text, end);
}

} // namespace

Scene with_method(const Scene& resolved, const MethodSettings& settings)
{
    Scene out = resolved;
    out.method = settings;
    return out;
}

double prior_ms(const Plan& plan, const DeviceTraits& traits)
{
    double dispatches = 0, bytes = 0;
    for (const EffectCost& effect : plan.effects)
    {
        dispatches += static_cast<double>(effect.dispatches_per_step);
        bytes += static_cast<double>(effect.bytes_per_step);
    }
    const double ns = dispatches * traits.dispatch_ns + bytes / kElementBytes * traits.element_ns;
    return 1e-6 * ns / plan.timestep;
}

SceneFacts scene_facts(const PhysicalModel& model, const CostReference& reference)
{
    SceneFacts out;
    for (std::size_t f = 1; f < reference.frames.size() && reference.frames.size() > 2; ++f)
        for (std::size_t i = 0; i < model.mass.size(); ++i)
        {
            const double moved = glm::distance(reference.frames[f][i], reference.frames[f - 1][i]);
            out.largest_speed = std::max(out.largest_speed, moved / model.timestep);
        }
    out.shortest = std::numeric_limits<double>::infinity();
    for (const StretchElement& spring : model.springs)
    {
        if (spring.rest_length > 0)
            out.shortest = std::min(out.shortest, spring.rest_length);
        out.rigid += spring.compliance == 0;
        if (model.pinned[spring.a] || model.pinned[spring.b])
            continue;
        const double ratio = model.mass[spring.a] / model.mass[spring.b];
        out.mass_ratio = std::max({out.mass_ratio, ratio, 1 / ratio});
    }
    out.springs = model.springs.size();
    out.free_coordinates =
        3 * static_cast<std::size_t>(std::count(model.pinned.begin(), model.pinned.end(), false));
    return out;
}

std::string filtered(const Scene& resolved, const SceneFacts& facts, const DeviceTraits& traits, double bound,
                     Candidate& candidate)
{
    const MethodSettings& settings = candidate.settings;
    if (settings.precision == "double" && !traits.float64)
        return "the device has no double";
    if (settings.type == "xpbd" && facts.mass_ratio > 100 && bound < 0.01)
        return "mass ratio " + number(facts.mass_ratio) +
               " is above 100: XPBD needs too many sweeps for an error below 1 %";
    const double substep = resolved.timestep / settings.substeps;
    const bool constrains = settings.type == "implicit_constraints";
    if (constrains && facts.largest_speed * substep > 0.3 * facts.shortest)
        return "a vertex moves " + number(facts.largest_speed * substep) +
               " m in a substep, more than 0.3 of the shortest spring (" + number(facts.shortest) + " m)";
    const std::size_t rigid = settings.constraint_compliance == 0 ? facts.springs : facts.rigid;
    if (constrains && rigid > facts.free_coordinates)
        return std::to_string(rigid) + " constraints without compliance for " +
               std::to_string(facts.free_coordinates) + " coordinates that move";
    try
    {
        candidate.prior = prior_ms(make_plan(with_method(resolved, settings), traits), traits);
    }
    catch (const Error& error) // the plan says what the method cannot do
    {
        if (error.code() == ErrorCode::bad_input || error.code() == ErrorCode::out_of_memory)
            throw;
        return std::string(to_string(error.code())) + ": " + error.what();
    }
    return {};
}

} // namespace taut::tuning
