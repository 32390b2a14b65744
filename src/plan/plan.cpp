#include "taut/plan/plan.hpp"

#include "taut/plan/builder.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

void check_settings(const Scene& scene, const DeviceTraits& traits)
{
    if (!(scene.timestep > 0) || !std::isfinite(scene.timestep) || scene.timestep > 1)
        throw Error(ErrorCode::bad_timestep,
                    "timestep must lie in (0, 1] s, it is " + std::to_string(scene.timestep));
    if (scene.method.type != "xpbd")
        throw Error(ErrorCode::unsupported, "method.type \"" + scene.method.type + "\" is not there; there is \"xpbd\"");
    if (scene.method.substeps == 0 || scene.method.iterations == 0)
        throw Error(ErrorCode::bad_input, "method.substeps and method.iterations must be at least 1");
    if (scene.method.precision == "double" && !traits.float64)
        throw Error(ErrorCode::unsupported,
                    "method.precision is \"double\", but the device has no 64-bit floats; use \"float\" or another device");
}

/// The rows of the table that this scene calls for.
std::vector<const Effect*> wanted_effects(const Scene& scene, const PlanOptions& options)
{
    const auto& names = options.available_effects;
    std::vector<const Effect*> rows;
    for (const Effect& effect : effect_table())
    {
        const bool available = names.empty() || std::find(names.begin(), names.end(), effect.name) != names.end();
        if (available && effect.wanted(scene))
            rows.push_back(&effect);
    }
    return rows;
}

void record_stage(PlanBuilder& builder, const std::vector<const Effect*>& rows, Stage stage, const Moment& moment)
{
    for (const Effect* row : rows)
        if (row->stage == stage)
            row->record(builder, moment);
}

/// One time step of XPBD with small substeps.
/// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1.
/// Departures: contacts are projected after the constraints of every iteration.
void record_step(PlanBuilder& builder, const std::vector<const Effect*>& rows)
{
    const Plan& plan = builder.plan;
    for (std::uint32_t s = 0; s < plan.substeps; ++s)
    {
        Moment moment{s, 0, false};
        for (const Stage stage : {Stage::force, Stage::predict, Stage::hold})
            record_stage(builder, rows, stage, moment);
        for (std::uint32_t i = 0; i < plan.iterations; ++i)
        {
            moment.iteration = i;
            moment.last = s + 1 == plan.substeps && i + 1 == plan.iterations;
            record_stage(builder, rows, Stage::solve, moment);
            record_stage(builder, rows, Stage::contact, moment);
        }
        record_stage(builder, rows, Stage::finish, moment);
    }
}

} // namespace

Plan make_plan(const Scene& resolved, const DeviceTraits& traits, const PlanOptions& options)
{
    check_settings(resolved, traits);
    PlanBuilder builder(resolved, traits, options);
    const std::vector<const Effect*> rows = wanted_effects(resolved, options);
    // The state comes first: other effects bind it.
    for (const Effect* row : rows)
        if (row->prepare != nullptr && row->stage == Stage::predict)
            row->prepare(builder);
    for (const Effect* row : rows)
        if (row->prepare != nullptr && row->stage != Stage::predict)
            row->prepare(builder);
    record_step(builder, rows);
    builder.plan.barrier_before = derive_barriers(builder.plan.passes);
    return std::move(builder.plan);
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
