#include "taut/plan/plan.hpp"

#include "taut/plan/added_elements.hpp"
#include "taut/plan/builder.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/plan/effect_names.hpp"
#include "taut/plan/plasticity.hpp"
#include "taut/plan/plate.hpp"
#include "taut/plan/pressure.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace taut {
namespace {

/// The square of a substep's inverse must stay finite in single precision, also times a compliance.
constexpr double kMinSubstep = 1e-15;

void check_values(const Scene& scene)
{
    find_method(scene.method.type); // or throws
    check_timestep(scene.timestep, scene.method.substeps);
    for (const SceneIssue& issue : check_resolved(scene))
        if (issue.error)
            throw Error(issue.code, issue.field + " " + issue.text);
}

Refusals refusals_of(const Scene& scene, const DeviceTraits& traits)
{
    Refusals out;
    out.attempt([&] {
        if (scene.method.precision == Precision::float64 && !traits.float64)
            throw Error(ErrorCode::unsupported,
                        "method.precision is \"double\", but the device has no 64-bit "
                        "floats; use \"float\" or another device");
    });
    check_solids(scene, out);
    check_pressure(scene, out);
    check_plasticity(scene, out);
    check_plate(scene, out);
    check_added_elements(scene, out);
    check_contact(scene, out);
    const Method& method = find_method(scene.method.type);
    if (method.check != nullptr)
        method.check(scene, out);
    return out;
}

/// Single precision where it cannot show what happens: positions carry two floats, but a substep's fall must
/// be above their last digit, and colliders and led vertices are placed by one float only.
void warn_of_precision(const Scene& scene, PlanBuilder& builder)
{
    if (builder.plan.precision == Precision::float64)
        return;
    constexpr double kUnit = 0x1p-24;
    double far = 0;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec3& x : builder.start)
    {
        far = std::max({far, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const double h = scene.timestep / builder.plan.substeps, fall = glm::length(scene.gravity) * h * h;
    const double last_digit = kUnit * kUnit * far;
    std::vector<PlanWarning>& warnings = builder.plan.warnings;
    if (fall > 0 && last_digit > 0.25 * fall)
        warnings.push_back({"precision", 1,
                            "a substep falls " + shown(fall, 3) + " m, the last digit of a position is " +
                                shown(last_digit, 3) +
                                " m; use double, longer substeps or places nearer the origin"});
    const bool placed = !scene.colliders.empty() || !builder.plan.moving_pins.empty();
    const double extent = builder.start.empty() ? 0 : glm::length(high - low);
    if (placed && extent > 0 && kUnit * far > 1e-4 * extent)
        warnings.push_back({"precision", 1,
                            "colliders and led vertices are placed to " + shown(kUnit * far, 3) +
                                " m; use double or places nearer the origin"});
}

/// Of bodies that would take more substeps than there may be: heavy ends, stiff solids on colliders, gases.
void warn_of_few_substeps(const Scene& scene, PlanBuilder& builder)
{
    if (builder.plan.substeps < kMostSubsteps)
        return; // named, or as many as the scene asks for
    const double wanted = wanted_substeps(scene);
    // Under implicit_euler only solids that stand on something ask for many, whatever the iterations.
    const bool sweeps = scene.method.type != MethodKind::implicit_euler;
    if (wanted > kMostSubsteps)
        builder.plan.warnings.push_back(
            {"few_substeps", 1,
             "mesh, material and time step ask for " + shown(wanted, 3) + " substeps, more than the " +
                 std::to_string(kMostSubsteps) + " there may be; use a shorter timestep (" +
                 shown(scene.timestep * kMostSubsteps / wanted, 2) +
                 " s), a coarser mesh" +
                 (sweeps ? ", more iterations or method.type \"implicit_euler\"" : " or a softer solid")});
}

/// The rows of the table that this scene calls for.
std::vector<const Effect*> wanted_effects(const Scene& scene, const PlanOptions& options)
{
    const auto& names = options.available_effects;
    std::vector<const Effect*> rows;
    for (const Effect& effect : effect_table())
    {
        const bool available =
            names.empty() || std::find(names.begin(), names.end(), effect.name) != names.end();
        const bool acts = (effect.methods & only(scene.method.type)) != 0;
        if (available && acts && effect.wanted(scene))
            rows.push_back(&effect);
    }
    return rows;
}

void record_stage(PlanBuilder& builder, const std::vector<const Effect*>& rows, Stage stage,
                  const Moment& moment)
{
    for (const Effect* row : rows)
        if (row->stage == stage && row->record != nullptr)
            row->record(builder, moment);
}

/// One time step in substeps, whatever the method: an inertial guess, corrections of it, the new state.
/// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1.
/// Departures: contacts are projected after the constraints, of every iteration or of the last.
void record_step(PlanBuilder& builder, const std::vector<const Effect*>& rows)
{
    const Plan& plan = builder.plan;
    for (std::uint32_t s = 0; s < plan.substeps; ++s)
    {
        Moment moment{s, 0, false};
        for (const Stage stage : {Stage::force, Stage::predict, Stage::hold, Stage::start})
            record_stage(builder, rows, stage, moment);
        for (std::uint32_t i = 0; i < plan.iterations; ++i)
        {
            moment.iteration = i;
            const bool end = i + 1 == plan.iterations;
            moment.last = s + 1 == plan.substeps && end;
            record_stage(builder, rows, Stage::solve, moment);
            if (!builder.method.contact_each_iteration)
                moment.iteration = 0; // contacts have one iteration then
            if (builder.method.contact_each_iteration || end)
                record_stage(builder, rows, Stage::contact, moment);
        }
        for (const Stage stage : {Stage::finish, Stage::after})
            record_stage(builder, rows, stage, moment);
    }
}

} // namespace

std::vector<std::string> effect_names(const Scene& resolved)
{
    std::vector<std::string> names;
    for (const Effect* effect : wanted_effects(resolved, {}))
        if (std::find(names.begin(), names.end(), effect->name) == names.end())
            names.emplace_back(effect->name);
    return names;
}

void check_timestep(double timestep, std::uint32_t substeps, double largest)
{
    if (!(timestep > 0) || timestep > 1 || timestep / substeps < kMinSubstep)
        throw Error(ErrorCode::bad_timestep,
                    "timestep is " + shown(timestep) + " s in " + std::to_string(substeps) +
                        " substeps; it must lie in (0, 1] s, a substep at least 1e-15 s");
    if (largest > 0 && timestep / substeps > largest)
        throw Error(ErrorCode::unstable_timestep,
                    "timestep is " + shown(timestep, 4) + " s in " + std::to_string(substeps) +
                        " substeps; the longest stable substep is " + shown(largest, 4) + " s, so " +
                        shown(std::ceil(timestep / largest)) + " would do");
}

std::vector<SceneIssue> plan_issues(const Scene& resolved, const DeviceTraits& traits)
{
    const Refusals refusals = refusals_of(resolved, traits);
    std::vector<SceneIssue> out;
    for (const Error& error : refusals.found())
        out.push_back(issue_of(error));
    return out;
}

Plan make_plan(const Scene& resolved, const DeviceTraits& traits, const PlanOptions& options)
{
    if (resolved.method.substeps == 0 || resolved.method.iterations == 0)
    {
        Scene counted = resolved;
        count_steps(counted);
        return make_plan(counted, traits, options);
    }
    check_values(resolved);
    refusals_of(resolved, traits).throw_first();
    PlanBuilder builder(resolved, traits, options);
    const std::vector<const Effect*> rows = wanted_effects(resolved, options);
    // The state comes first: other effects bind it.
    for (const Effect* row : rows)
        if (row->prepare != nullptr && row->stage == Stage::predict)
            row->prepare(builder);
    for (const Effect* row : rows)
        if (row->prepare != nullptr && row->stage != Stage::predict)
            row->prepare(builder);
    warn_of_precision(resolved, builder);
    warn_of_few_substeps(resolved, builder);
    record_step(builder, rows);
    builder.finish_paper();
    builder.plan.barrier_before = derive_barriers(builder.plan.passes);
    check_no_hazard(builder.plan.passes, builder.plan.barrier_before);
    return std::move(builder.plan);
}

std::vector<std::string> EffectCost::kernel_names() const
{
    std::vector<std::string> names;
    for (const KernelCost& kernel : kernels)
        names.push_back(kernel.name);
    return names;
}

std::uint64_t Plan::bytes_allocated() const
{
    std::uint64_t bytes = 0;
    for (const PlanBuffer& buffer : buffers)
        bytes += buffer.bytes;
    return bytes;
}

std::uint64_t Plan::barrier_count() const
{
    return static_cast<std::uint64_t>(std::count(barrier_before.begin(), barrier_before.end(), true));
}

std::map<std::string, std::uint64_t> Plan::constraint_counts() const
{
    std::map<std::string, std::uint64_t> counts;
    for (const ConstraintSet& set : constraints)
        counts[set.kind] = set.count;
    return counts;
}

std::map<std::string, std::uint64_t> Plan::colour_counts() const
{
    std::map<std::string, std::uint64_t> counts;
    for (const ConstraintSet& set : constraints)
        counts[set.kind] = std::max(set.colour_count(), set.small_colours);
    return counts;
}

} // namespace taut
