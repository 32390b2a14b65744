// Mass-spring: forces gathered at the vertices, velocities and places by an explicit integrator.
//
// Based on: Provot. Deformation Constraints in a Mass-Spring Model to Describe Rigid Cloth Behavior. Graphics
//   Interface 1995; Hairer, Lubich, Wanner. Geometric Numerical Integration, 2nd ed. 2006, I.1 (explicit and
//   semi-implicit Euler, velocity Verlet).
// Departures: the integrators are kicks around the frame's own step v += h g, x += h v, which makes a substep
// of
//   every method (docs/decisions.md 25). Verlet forms the forces twice a substep, so that a state needs no
//   forces of the step before.

#include "taut/plan/mass_spring.hpp"

#include "taut/kernels/force_kick.hpp"
#include "taut/kernels/slot_sum.hpp"
#include "taut/kernels/spring_force.hpp"
#include "taut/kernels/spring_slots.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/springs.hpp"
#include "taut/plan/stability.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

void record_gather(PlanBuilder& b, std::uint32_t report)
{
    const ForceBuffers& f = *b.forces;
    const std::uint32_t n = b.plan.vertex_count, each = per_vertex(b, 2 * std::uint64_t(f.springs));
    kernels::spring_force::Bindings<Use> uses = {.start = {f.start},
                                                 .end = {f.ends, each},
                                                 .position = {b.plan.position, 1 + each},
                                                 .low = {b.plan.low, 1 + each},
                                                 .force = {f.force},
                                                 .events = {b.plan.events, 0}};
    if (f.damped)
        uses.velocity = {b.plan.velocity, 1 + each};
    b.dispatch("spring_force", f.damped ? "damped" : "", uses, {n, report}, n);
}

void record_slots(PlanBuilder& b, std::uint32_t report)
{
    const ForceBuffers& f = *b.forces;
    const std::uint32_t n = b.plan.vertex_count, each = per_vertex(b, 2 * std::uint64_t(f.springs));
    kernels::spring_slots::Bindings<Use> uses = {.spring = {f.records},
                                                 .position = {b.plan.position, 2},
                                                 .low = {b.plan.low, 2},
                                                 .slot = {f.slots},
                                                 .events = {b.plan.events, 0}};
    if (f.damped)
        uses.velocity = {b.plan.velocity, 2};
    b.dispatch("spring_force", f.damped ? "damped" : "", uses, {f.springs, report}, f.springs);
    const kernels::slot_sum::Bindings<Use> sum = {
        .start = {f.start}, .incident = {f.incident, each}, .slot = {f.slots, each}, .force = {f.force}};
    b.dispatch("spring_force", "", sum, {n}, n);
}

void record_springs(PlanBuilder& b, bool report)
{
    if (forces(b).springs == 0)
        return;
    if (forces(b).node_centric)
        record_gather(b, report);
    else
        record_slots(b, report);
}

void record_kick(PlanBuilder& b, float force_share, float gravity_share)
{
    const std::uint32_t n = b.plan.vertex_count;
    const kernels::force_kick::Bindings<Use> uses = {.position = {b.plan.position},
                                                     .force = {b.forces->force},
                                                     .velocity = {b.plan.velocity},
                                                     .step_values = {b.plan.step_values, 0},
                                                     .events = {b.plan.events, 0}};
    b.dispatch("force_kick", "", uses, {n, force_share, gravity_share}, n);
}

/// Explicit Euler multiplies a mode's amplitude by sqrt(1 + h^2 omega^2) in every substep.
void warn_of_growth(PlanBuilder& b)
{
    const double h = b.plan.timestep / b.plan.substeps, rate = rate_bounds(b.scene).stiffness;
    if (b.scene.method.integrator != Integrator::explicit_euler || !(rate > 0))
        return;
    b.plan.warnings.push_back(
        {"energy_growth", 1,
         "explicit Euler gains energy in every substep: the stiffest motion grows by up to a factor of " +
             shown(std::exp(std::log1p(rate * h * h) / (2 * h)), 3) +
             " a second where nothing damps it; use integrator \"semi_implicit\" or \"verlet\""});
}

} // namespace

ForceBuffers& forces(PlanBuilder& b)
{
    if (!b.forces)
        b.forces = std::make_shared<ForceBuffers>();
    return *b.forces;
}

void add_force_buffer(PlanBuilder& b, std::string_view effect)
{
    ForceBuffers& f = forces(b);
    if (f.force == kNoBuffer)
        f.force =
            b.add_buffer(effect, "inner forces", std::uint64_t(b.plan.vertex_count) * 4 * b.real_size());
}

std::uint32_t per_vertex(const PlanBuilder& b, std::uint64_t ends)
{
    return static_cast<std::uint32_t>(ends / std::max(b.plan.vertex_count, 1u) + 1);
}

bool report_now(const PlanBuilder& b, const Moment& moment) { return moment.substep + 1 == b.plan.substeps; }

void add_inner_forces(PlanBuilder& b, std::string_view effect, std::uint32_t springs)
{
    forces(b).springs = springs;
    add_force_buffer(b, effect);
}

void check_mass_spring(const Scene& scene, Refusals& out) { refuse_rigid(scene, out); }

bool wants_forces_after(const Scene& scene) { return scene.method.integrator == Integrator::verlet; }
bool wants_kick_after(const Scene& scene) { return scene.method.integrator != Integrator::semi_implicit; }

double velocity_lead(const Scene& scene)
{
    if (scene.method.type != MethodKind::mass_spring || !wants_kick_after(scene))
        return -0.5;
    return scene.method.integrator == Integrator::verlet ? 0 : 0.5;
}

bool wants_kick(const Scene& scene)
{
    return wants_kick_after(scene) ||
           std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
               return has_springs(b) || !b.elements.empty() ||
                      (resists_bending(b.material) && !b.mesh.triangles.empty());
           });
}

void prepare_spring_force(PlanBuilder& b)
{
    std::vector<StretchElement> elements = all_springs(b);
    std::erase_if(elements, [&](const StretchElement& e) { return !acts_as_force(b.scene, e); });
    ForceBuffers& f = forces(b);
    f.springs = static_cast<std::uint32_t>(elements.size());
    if (elements.empty())
        return;
    f.node_centric = b.scene.method.scheme != ElementScheme::spring_centric;
    f.damped = std::any_of(elements.begin(), elements.end(),
                           [](const StretchElement& e) { return e.damping > 0; });
    const Incidence at = incidence_of(b.plan.vertex_count, elements);
    with_real(b.plan.precision, [&](auto zero) {
        using Record = layout::Spring<decltype(zero)>;
        const std::vector<Record> records = records_of(elements, spring_record<decltype(zero)>);
        std::vector<Record> ends;
        if (!f.node_centric)
        {
            f.records = b.add_buffer<Record>("spring_force", "springs", records);
            return;
        }
        for (const std::uint32_t entry : at.entries)
        {
            ends.push_back(records[entry / 2]);
            if (entry % 2 == 1)
                std::swap(ends.back().a, ends.back().b);
        }
        f.ends = b.add_buffer<Record>("spring_force", "spring ends", ends);
    });
    f.start = b.add_buffer<std::uint32_t>("spring_force", "springs at a vertex, start", at.start);
    if (!f.node_centric)
    {
        f.incident = b.add_buffer<std::uint32_t>("spring_force", "springs at a vertex", at.entries);
        f.slots = b.add_buffer("spring_force", "slots", std::uint64_t(f.springs) * 4 * b.real_size());
    }
    add_force_buffer(b, "spring_force");
}

void prepare_force_kick(PlanBuilder& b)
{
    if (wants_kick_after(b.scene))
        add_force_buffer(b, "force_kick"); // zero, where nothing pulls
    warn_of_growth(b);
}

void record_spring_force(PlanBuilder& b, const Moment& moment) { record_springs(b, report_now(b, moment)); }
void record_spring_force_after(PlanBuilder& b, const Moment&) { record_springs(b, false); }

void record_force_kick(PlanBuilder& b, const Moment&)
{
    if (forces(b).force == kNoBuffer)
        return;
    const Integrator integrator = b.scene.method.integrator;
    if (integrator == Integrator::explicit_euler)
        record_kick(b, 0, -1);
    else if (integrator == Integrator::verlet)
        record_kick(b, 0.5f, -0.5f);
    else
        record_kick(b, 1, 0);
}

void record_force_kick_after(PlanBuilder& b, const Moment&)
{
    const float share = b.scene.method.integrator == Integrator::verlet ? 0.5f : 1;
    record_kick(b, share, share);
}

} // namespace taut
