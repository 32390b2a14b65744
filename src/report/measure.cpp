// What a world looks like from outside, in fp64 on the host.

#include "taut/plan/methods.hpp"
#include "taut/report/contact_depth.hpp"
#include "taut/report/deep_vertices.hpp"
#include "taut/report/energy_lost.hpp"
#include "taut/report/measure_residuals.hpp"
#include "taut/report/report.hpp"
#include "taut/report/scene_budget.hpp"
#include "taut/report/warnings.hpp"
#include "taut/report/world_view.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

using reference::BendingRecord;
using reference::DistanceRecord;
using reference::View;

void measure_stretch(const View& view, StepReport& out)
{
    double sum = 0;
    std::size_t counted = 0;
    bool first = true;
    for (const DistanceRecord& c : view.distance)
    {
        if (!(c.rest_length > 0))
            continue;
        out.springs = true;
        const double stretch = (view.length(c) - c.rest_length) / c.rest_length;
        out.max_stretch = first ? stretch : std::max(out.max_stretch, stretch);
        first = false;
        sum += std::max(stretch, 0.0) * std::max(stretch, 0.0);
        ++counted;
    }
    for (const AddedElement& e : view.model.added)
        if (const auto stretches = e.stretches(view.x))
        {
            const double stretch = (*stretches)[1];
            out.springs = true;
            out.max_stretch = first ? stretch : std::max(out.max_stretch, stretch);
            first = false;
            sum += std::max(stretch, 0.0) * std::max(stretch, 0.0);
            ++counted;
        }
    out.rms_stretch = counted > 0 ? std::sqrt(sum / static_cast<double>(counted)) : 0;
}

void measure_energy(const View& view, StepReport& out)
{
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        if (view.model.pinned[i])
            continue;
        out.kinetic_energy += 0.5 * view.model.mass[i] * glm::dot(view.v[i], view.v[i]);
        out.max_speed = std::max(out.max_speed, glm::length(view.v[i]));
    }
    out.potential_energy = gravity_energy(view.model, view.x) + gas_energy(view.model, view.x);
    for (const DistanceRecord& c : view.distance)
        if (c.compliance > 0)
            out.potential_energy += 0.5 * std::pow(view.length(c) - c.rest_length, 2) / c.compliance;
    if (view.model.plates.empty())
        for (const BendingRecord& c : view.bending)
        {
            if (c.compliance > 0)
                out.potential_energy +=
                    0.5 * std::pow(reference::angle_difference(view.angle(c).angle, c.rest_angle), 2) /
                    c.compliance;
        }
    else // records have bounds on their energy
        out.potential_energy += bending_energy(view.model, view.x);
    for (const VolumeElement& e : view.model.volumes)
        if (e.compliance > 0)
            out.potential_energy +=
                0.5 * std::pow(volume_of(e.vertex, view.x) - e.rest_volume, 2) / e.compliance;
    for (const SurfaceElement& e : view.model.surfaces)
        if (e.compliance > 0)
            out.potential_energy +=
                0.5 * std::pow(enclosed_volume(e.triangles, view.x) - e.rest_volume, 2) / e.compliance;
    for (const SolidElement& e : view.model.solids)
        out.potential_energy += solid_energy(e, view.x);
    for (const AddedElement& e : view.model.added)
        out.potential_energy += e.energy(view.x);
}

void measure_penetration(const View& view, StepReport& out)
{
    const Scene& scene = view.world.scene();
    const std::vector<DeepVertex> deep = deep_vertices(scene, view.x, view.world.time());
    for (const DeepVertex& vertex : deep)
        out.penetration = std::max(out.penetration, vertex.depth);
    set_status(judge_depth(scene, deep), out);
}

/// Momentum against the impulse of gravity; only a free, undamped body without contacts has one to keep.
/// Returns whether bodies were given any: thrown, or by gravity. What starts strained and at rest has
/// rounding alone, of speeds that it may have had on the way.
bool measure_momentum(const View& view, StepReport& out)
{
    const Scene& scene = view.world.scene();
    out.momentum_error = -1;
    const bool pins =
        std::any_of(view.model.pinned.begin(), view.model.pinned.end(), [](bool p) { return p; });
    const WorldDrive drive = view.world.drive();
    const bool driven = drive.placed > 0 || drive.kick > 0 || scene.max_speed > 0; // by its program, or cut
    const bool pushed = scene.damping > 0 || scene.external_forces || view.plan.wind != kNoBuffer;
    if (pins || driven || pushed || !scene.colliders.empty() || view.x.empty())
        return false;
    glm::dvec3 now(0), before(0);
    double mass = 0, start = 0, end = 0, far = 0; // start, end: J, twice the kinetic energy
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        now += view.model.mass[i] * view.v[i];
        before += view.model.mass[i] * view.model.velocity[i];
        mass += view.model.mass[i];
        start += view.model.mass[i] * glm::dot(view.model.velocity[i], view.model.velocity[i]);
        end += view.model.mass[i] * glm::dot(view.v[i], view.v[i]);
        far = std::max(far, glm::length(view.x[i]));
    }
    const glm::dvec3 expected = before + mass * view.world.gravity_impulse();
    const double fall = std::sqrt(glm::length(scene.gravity) * view.model.diameter);
    const double substep = view.plan.timestep / view.plan.substeps;
    const double rounded = rounded_way(view.plan.precision, far) / substep;
    const double speed = std::max({std::sqrt(start / mass), std::sqrt(end / mass), fall, rounded});
    out.momentum_error =
        speed > 0 ? glm::length(now - expected) / (mass * speed) : glm::length(now - expected) / mass;
    return start > 0 || fall > 0;
}

std::uint64_t hash_of(const WorldState& state)
{
    std::uint64_t hash = 14695981039346656037ull;
    for (const auto* bytes : {&state.position, &state.low})
        for (const std::byte b : *bytes)
            hash = (hash ^ static_cast<std::uint64_t>(b)) * 1099511628211ull;
    return hash;
}

void judge_all(const View& view, StepReport& out)
{
    const Events events = view.world.events();
    add_warnings(events, out.warnings);
    count(Warning::iteration_limit, out.solver.limited, out.warnings);
    count(Warning::solve_failed, out.solver.failed, out.warnings);
    for (const PlanWarning& warning : view.plan.warnings)
        out.warnings[warning.word] += warning.count;
    const std::shared_ptr<void> kept_elsewhere; // the view outlives the budget
    const std::shared_ptr<const PhysicalModel> model(kept_elsewhere, &view.model);
    const Soundness found = taut::judge(SceneBudget(view.world.scene(), model), view.world);
    out.judged_energy = found.energy;
    out.energy_most = found.energy_most;
    out.energy_lost = energy_lost(view.world, view.model, view.x, found, out);
    set_status(found, out);
}

} // namespace

void set_status(const Soundness& found, StepReport& report)
{
    if (rank(found.status) <= rank(report.status))
        return;
    report.status = found.status;
    report.reason = found.reason;
}

void judge_residuals(const Scene& scene, StepReport& report)
{
    if (report.stretch_residual > scene.accept.stretch)
        set_status({Status::unconverged, "by the multipliers a spring is " +
                                             shown(100 * report.stretch_residual, 3) +
                                             " % of its length from where it should be, accept.stretch is " +
                                             shown(100 * scene.accept.stretch, 3) +
                                             " %; take more substeps or iterations"},
                   report);
    if (report.flow_residual > kFlowShare)
        set_status({Status::unconverged, "springs have flowed by what the solver left of them: by the "
                                         "multipliers one is " +
                                             shown_percent(report.flow_residual) +
                                             " of its plastic_yield from where it should be, " +
                                             shown_percent(kFlowShare) +
                                             " are accepted; take more substeps or iterations"},
                   report);
    if (report.imbalance > scene.accept.residual)
        set_status({Status::unconverged, "the solver left " + shown(100 * report.imbalance, 3) +
                                             " % of the forces, accept.residual is " +
                                             shown(100 * scene.accept.residual, 3) +
                                             " %; take more substeps or iterations"},
                   report);
}

namespace {

void judge_momentum(StepReport& report)
{
    if (report.momentum_error <= kMomentumShare)
        return;
    const char* why = report.contacts.crowded > 0 ? "; vertices in more pairs than may push them take it"
                      : report.contacts.guarded   ? "; the guarantee of contact takes it where it cuts"
                                                  : "";
    set_status({Status::unconverged, "the momentum of bodies that nothing holds is off by " +
                                         shown_percent(report.momentum_error) +
                                         " of what their speed makes" + why +
                                         "; take more substeps or iterations"},
               report);
}

/// What the guarantee holds stands still whatever pushes it, for a substep at a time.
void judge_held(const View& view, StepReport& report)
{
    const double ways = static_cast<double>(view.plan.vertex_count) *
                        static_cast<double>(view.world.steps()) * view.plan.substeps;
    const double held = static_cast<double>(report.contacts.held);
    if (held > kHeldShare * ways)
        set_status({Status::unconverged,
                    "the guarantee of contact held vertices still in " + shown_percent(held / ways) +
                        " of all vertices x substeps, up to " + shown_percent(kHeldShare) +
                        " are accepted; give surfaces a thickness below the edges of their meshes"},
                   report);
}

} // namespace

StepReport measure(const World& world)
{
    const View view(world);
    StepReport out;
    out.step = world.steps();
    out.time = world.time();
    measure_stretch(view, out);
    measure_energy(view, out);
    const bool given = measure_momentum(view, out);
    measure_residuals(view, out);
    out.volume = measure_volume(world.scene(), view.x);
    out.contacts = world.contacts();
    out.contact_forces = world.contact_forces();
    out.contact_depth = contact_depth(world, view.x);
    out.torn = world.torn();
    out.position_hash = hash_of(world.state());
    out.solver = world.solver_report();
    out.active_share = world.active_share();
    judge_all(view, out);
    judge_residuals(world.scene(), out);
    judge_held(view, out);
    if (given)
        judge_momentum(out);
    measure_penetration(view, out);
    return out;
}

} // namespace taut
