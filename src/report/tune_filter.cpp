// What can be said of a setting without simulating: that it cannot work, and about what it costs.
#include "taut/report/cost_design.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/report/volume.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::tuning {
namespace {

/// Bytes that one distance constraint moves in float: its record, and two vertices read and written.
constexpr double kElementBytes = 112;

} // namespace

void check_input(const Scene& scene, const TuneOptions& options)
{
    if (!(options.error > 0 && options.error < 1))
        throw Error(ErrorCode::bad_input, "the error to keep must be above 0 and below 1; 0.01 is 1 %.");
    if (options.precisions.empty())
        throw Error(ErrorCode::bad_input, "precisions to try must name float, double or both.");
    if (scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "bodies is empty: there is nothing to tune; add a body.");
    if (!(options.seconds >= 0))
        throw Error(ErrorCode::bad_input, "the seconds of the search must be 0 or more.");
    if (options.by == TuneCriterion::volume && options.kind == CostKind::at_rest)
        throw Error(ErrorCode::bad_input,
                    "an error of volume is the worst of all frames; leave out that it is at rest.");
}

void check_volumes(const Scene& resolved, const TuneOptions& options)
{
    if (options.by == TuneCriterion::volume && !measure_volume(resolved, make_model(resolved).start).any)
        throw Error(ErrorCode::bad_input, "no body has a volume: an error of volume is one of bodies of "
                                          "tetrahedra, or of closed cloth that holds its volume.");
}

std::vector<Candidate> designed(const Scene& resolved, const std::vector<MethodKind>& methods,
                                const std::vector<Precision>& precisions)
{
    std::vector<Candidate> out{{resolved.method, 0, true}};
    for (const MethodKind kind : methods)
        for (const Precision precision : precisions)
            for (MethodSettings& settings : method_design(kind, precision, resolved.method))
                if (settings_block(settings) != settings_block(resolved.method))
                    out.push_back({std::move(settings), 0, false});
    return out;
}

bool fell_in_float(const std::vector<TuneRejection>& rejected, const MethodSettings& settings)
{
    MethodSettings twin = settings;
    twin.precision = Precision::float32;
    const std::string block = settings_block(twin);
    return settings.precision == Precision::float64 &&
           std::any_of(rejected.begin(), rejected.end(), [&](const TuneRejection& r) {
               return r.stage != "filter" && r.stage != "material" && settings_block(r.settings) == block;
           });
}

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

namespace {

void add_strains(const PhysicalModel& model, const std::vector<glm::dvec3>& x, SceneFacts& out)
{
    for (const StretchElement& spring : model.springs)
    {
        if (!(spring.rest_length > 0))
            continue;
        const double strain = glm::distance(x[spring.a], x[spring.b]) / spring.rest_length - 1;
        out.strain = std::max(out.strain, strain);
        out.shortening = std::max(out.shortening, -strain);
        if (spring.kind != SpringKind::structural)
            continue;
        out.structural_strain = std::max(out.structural_strain, strain);
        out.structural_shortening = std::max(out.structural_shortening, -strain);
    }
}

/// What acad's constraints keep the springs from; empty: nothing.
std::string held_by_acad(const SceneFacts& facts, const MethodSettings& settings)
{
    const bool structural = settings.constrained == ConstrainedSprings::structural;
    const double longer = structural ? facts.structural_strain : facts.strain;
    const double shorter = structural ? facts.structural_shortening : facts.shortening;
    const bool pressed = settings.compress && shorter > settings.activate_strain;
    if (!pressed && !(longer > settings.activate_strain))
        return {};
    return "acad holds a spring at a strain of " + shown(settings.activate_strain, 3) + ", the reference " +
           (pressed ? "presses one by " + shown(shorter, 3) : "stretches one by " + shown(longer, 3));
}

template <class Elements>
bool any_stiff(const Elements& elements)
{
    return std::any_of(elements.begin(), elements.end(),
                       [](const auto& e) { return e.compliance > 0 && std::isfinite(e.compliance); });
}

} // namespace

std::string other_material(const SceneFacts& facts, const MethodSettings& settings)
{
    if (settings.type == MethodKind::pbd && facts.stiff)
        return "pbd does not have the material's stiffness: its own has no unit and lies in [0, 1]";
    if (const std::string held = held_by_acad(facts, settings);
        settings.type == MethodKind::acad && !held.empty())
        return held;
    if ((settings.type == MethodKind::acad || settings.type == MethodKind::implicit_constraints) &&
        facts.stiff && settings.constraint_compliance)
        return std::string(to_string(settings.type)) + " gives every constraint a compliance of " +
               shown(*settings.constraint_compliance, 3) + " m/N in place of the material's";
    return {};
}

SceneFacts scene_facts(const PhysicalModel& model, const CostReference& reference)
{
    SceneFacts out;
    out.stiff = any_stiff(model.springs) || any_stiff(model.hinges) || any_stiff(model.volumes) ||
                any_stiff(model.surfaces) || !model.solids.empty();
    for (std::size_t f = 1; f < reference.frames.size(); ++f) // the start is left whatever the method
        add_strains(model, reference.frames[f], out);
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
    if (settings.precision == Precision::float64 && !traits.float64)
        return "the device has no double";
    if (settings.type == MethodKind::xpbd && facts.mass_ratio > 100 && bound < 0.01)
        return "mass ratio " + shown(facts.mass_ratio, 3) +
               " is above 100: XPBD needs too many sweeps for an error below 1 %";
    const double substep = resolved.timestep / settings.substeps;
    const bool constrains = settings.type == MethodKind::implicit_constraints;
    if (constrains && facts.largest_speed * substep > 0.3 * facts.shortest)
        return "a vertex moves " + shown(facts.largest_speed * substep, 3) +
               " m in a substep, more than 0.3 of the shortest spring (" + shown(facts.shortest, 3) + " m)";
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
