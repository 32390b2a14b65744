#include "taut/plan/plan.hpp"

#include "taut/plan/builder.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>

namespace taut {
namespace {

std::string shown(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

/// The square of a substep's inverse must stay finite in single precision, also times a compliance.
constexpr double kMinSubstep = 1e-15;

std::string place(std::size_t body, std::string_view list, std::size_t index)
{
    return "bodies[" + std::to_string(body) + "]." + std::string(list) + "[" + std::to_string(index) + "] ";
}

void check_springs(const Body& body, std::size_t b)
{
    const std::size_t count = body.mesh.positions.size();
    for (std::size_t k = 0; k < body.springs.size(); ++k)
    {
        const Body::Spring& s = body.springs[k];
        if (s.a >= count || s.b >= count || s.a == s.b)
            throw Error(ErrorCode::bad_input, place(b, "springs", k) + "joins vertices " + std::to_string(s.a) + " and " +
                                                  std::to_string(s.b) + "; they must differ, and the body has " +
                                                  std::to_string(count) + " vertices");
        if (!(s.rest_length >= 0) || !(s.compliance >= 0) || !std::isfinite(s.rest_length) || !std::isfinite(s.compliance))
            throw Error(ErrorCode::bad_input, place(b, "springs", k) + "has rest_length " + std::to_string(s.rest_length) +
                                                  " m and compliance " + std::to_string(s.compliance) +
                                                  " m/N; both must be finite, 0 or more");
    }
}

/// What a plan indexes and divides by. Scenes with meshes filled by hand have not passed check().
void check_body(const Body& body, std::size_t b)
{
    const std::size_t count = body.mesh.positions.size();
    check_springs(body, b);
    for (const Pin& pin : body.pins)
        for (std::size_t k = 0; k < pin.vertices.size(); ++k)
            if (pin.vertices[k] >= count)
                throw Error(ErrorCode::bad_input, place(b, "pins.vertices", k) + "is " + std::to_string(pin.vertices[k]) +
                                                      "; the body has " + std::to_string(count) + " vertices");
    for (const std::size_t size : {body.vertex_masses.size(), body.start_positions.size()})
        if (size != 0 && size != count)
            throw Error(ErrorCode::bad_input, "bodies[" + std::to_string(b) + "] has " + std::to_string(size) +
                                                  " vertex_masses or start_positions, but " + std::to_string(count) +
                                                  " vertices");
    for (std::size_t v = 0; v < body.vertex_masses.size(); ++v)
        if (!(body.vertex_masses[v] > 0) || !std::isfinite(body.vertex_masses[v]))
            throw Error(ErrorCode::bad_input, place(b, "vertex_masses", v) + "is " +
                                                  std::to_string(body.vertex_masses[v]) + " kg; it must be above 0 and finite");
    const auto& start = body.start_positions.empty() ? body.mesh.positions : body.start_positions;
    for (std::size_t v = 0; v < count; ++v)
        if (!std::isfinite(start[v].x + start[v].y + start[v].z))
            throw Error(ErrorCode::bad_input, place(b, "start_positions", v) + "is not finite");
}

void check_settings(const Scene& scene, const DeviceTraits& traits)
{
    if (scene.method.type != "xpbd")
        throw Error(ErrorCode::unsupported, "method.type \"" + scene.method.type + "\" is not there; there is \"xpbd\"");
    if (scene.method.substeps == 0 || scene.method.iterations == 0)
        throw Error(ErrorCode::bad_input, "method.substeps and method.iterations must be at least 1");
    check_timestep(scene.timestep, scene.method.substeps);
    if (scene.method.precision == "double" && !traits.float64)
        throw Error(ErrorCode::unsupported,
                    "method.precision is \"double\", but the device has no 64-bit floats; use \"float\" or another device");
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
    const double h = scene.timestep / scene.method.substeps, fall = glm::length(scene.gravity) * h * h;
    const double last_digit = kUnit * kUnit * far;
    std::vector<std::string>& warnings = builder.plan.warnings;
    if (fall > 0 && last_digit > 0.25 * fall)
        warnings.push_back("precision: a substep falls " + shown(fall) + " m, the last digit of a position is " +
                           shown(last_digit) + " m; use double, longer substeps or places nearer the origin");
    const bool placed = !scene.colliders.empty() || !builder.plan.moving_pins.empty();
    if (placed && !builder.start.empty() && kUnit * far > 1e-4 * glm::length(high - low))
        warnings.push_back("precision: colliders and led vertices are placed to " + shown(kUnit * far) +
                           " m; use double or places nearer the origin");
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

void check_timestep(double timestep, std::uint32_t substeps)
{
    if (!(timestep > 0) || timestep > 1 || timestep / substeps < kMinSubstep)
        throw Error(ErrorCode::bad_timestep, "timestep is " + std::to_string(timestep) + " s in " +
                                                 std::to_string(substeps) +
                                                 " substeps; it must lie in (0, 1] s, a substep at least 1e-15 s");
}

Plan make_plan(const Scene& resolved, const DeviceTraits& traits, const PlanOptions& options)
{
    check_settings(resolved, traits);
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
        check_body(resolved.bodies[b], b);
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
