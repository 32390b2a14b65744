// What a world looks like from outside, in fp64 on the host.
//
// Based on: Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 8 (primal) and eq. 9 (dual).
// Departures: the primal residual leaves out vertices that touch a collider, whose contact forces have
//   no multiplier on record.

#include "taut/plan/methods.hpp"
#include "taut/report/contact.hpp"
#include "taut/report/report.hpp"
#include "taut/report/soundness.hpp"
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
    for (const BendingRecord& c : view.bending)
        if (c.compliance > 0)
            out.potential_energy +=
                0.5 * std::pow(reference::angle_difference(view.angle(c).angle, c.rest_angle), 2) /
                c.compliance;
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
}

/// Signed distance of a point to a collider's surface at a time, m; of a box, to its nearest face.
double surface_gap(const Collider& c, double time, const glm::dvec3& x)
{
    return reference::surface_at(c, time).touch(x, 0).height;
}

void measure_penetration(const View& view, StepReport& out)
{
    for (const Collider& c : view.world.scene().colliders)
    {
        const reference::Surface surface = reference::surface_at(c, view.world.time());
        for (std::size_t i = 0; i < view.x.size(); ++i)
            if (!view.model.pinned[i])
                out.penetration = std::max(out.penetration, -surface.touch(view.x[i], 0).height);
    }
}

/// Momentum against the impulse of gravity; only a free, undamped body without contacts has one to keep.
void measure_momentum(const View& view, StepReport& out)
{
    const Scene& scene = view.world.scene();
    out.momentum_error = -1;
    const bool pins =
        std::any_of(view.model.pinned.begin(), view.model.pinned.end(), [](bool p) { return p; });
    const bool pushed = scene.damping > 0 || scene.external_forces || view.plan.wind != kNoBuffer;
    if (pins || pushed || !scene.colliders.empty() || view.x.empty())
        return;
    glm::dvec3 now(0), before(0);
    double mass = 0;
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        now += view.model.mass[i] * view.v[i];
        before += view.model.mass[i] * view.model.velocity[i];
        mass += view.model.mass[i];
    }
    const glm::dvec3 expected = before + mass * view.world.gravity_impulse();
    const double speed =
        std::max(glm::length(now) / mass, std::sqrt(glm::length(scene.gravity) * view.model.diameter));
    out.momentum_error =
        speed > 0 ? glm::length(now - expected) / (mass * speed) : glm::length(now - expected) / mass;
}

bool touches(const View& view, std::size_t i)
{
    for (const Collider& c : view.world.scene().colliders)
        if (surface_gap(c, view.world.time(), view.x[i]) <= view.model.gap[i] + 1e-6 * view.model.diameter)
            return true;
    return false;
}

/// Adds J^T lambda to `impulse` (kg m) and gives the dual residual of the distance constraints.
double distance_residual(const View& view, double h, std::vector<glm::dvec3>& impulse)
{
    const std::vector<double> lambda = view.world.multipliers("distance");
    if (lambda.empty())
        return 0;
    double worst = 0;
    for (std::size_t k = 0; k < view.distance.size(); ++k)
    {
        const DistanceRecord& c = view.distance[k];
        const double length = view.length(c);
        if (!(length > 0))
            continue;
        const glm::dvec3 n = (view.x[c.a] - view.x[c.b]) / length;
        impulse[c.a] += n * lambda[k];
        impulse[c.b] -= n * lambda[k];
        if (c.rest_length > 0)
            worst = std::max(worst, std::abs(length - c.rest_length + c.compliance / (h * h) * lambda[k]) /
                                        c.rest_length);
    }
    return worst;
}

double bending_residual(const View& view, double h, std::vector<glm::dvec3>& impulse)
{
    const std::vector<double> lambda = view.world.multipliers("bending");
    if (lambda.empty())
        return 0;
    double worst = 0;
    for (std::size_t k = 0; k < view.bending.size(); ++k)
    {
        const BendingRecord& c = view.bending[k];
        const auto angle = view.angle(c);
        if (!angle.valid)
            continue;
        const std::uint32_t ids[] = {c.edge0, c.edge1, c.wing0, c.wing1};
        for (std::size_t j = 0; j < 4; ++j)
            impulse[ids[j]] +=
                glm::dvec3(angle.gradient[j].x, angle.gradient[j].y, angle.gradient[j].z) * lambda[k];
        const double value = reference::angle_difference(angle.angle, c.rest_angle);
        worst = std::max(worst, std::abs(value + c.compliance / (h * h) * lambda[k]));
    }
    return worst;
}

/// r_acc of an implicit substep, |M (x - x~) - h^2 f(x)| / (m g h^2), and its share of all forces: what its
/// iterations left. Not there with dampers, whose force depends on the way, not on the place, and where
/// elements flow, whose rest shapes the model does not know.
void implicit_residual(const View& view, StepReport& out)
{
    const bool damped = std::any_of(view.model.springs.begin(), view.model.springs.end(),
                                    [](const StretchElement& e) { return e.damping > 0; });
    const auto& bodies = view.world.scene().bodies;
    const bool flows = std::any_of(bodies.begin(), bodies.end(),
                                   [](const Body& body) { return body.material.plastic_yield > 0; });
    if (view.plan.predicted == kNoBuffer || view.world.steps() == 0 || damped || flows)
        return;
    const double h = view.plan.timestep / view.plan.substeps, gravity = glm::length(view.model.gravity);
    const std::vector<glm::dvec3> moved = view.world.displacements(), guess = view.world.predictions();
    std::vector<glm::dvec3> force(view.x.size(), glm::dvec3(0));
    add_forces(view.model, view.x, force);
    std::vector<glm::dvec3> gas(view.x.size(), glm::dvec3(0)); // of the guess, which it has pushed
    for (const GasElement& e : view.model.gases)
        add_gas_forces(e, view.x, gas);
    std::vector<double> size(view.x.size(), 0.0);
    add_force_sizes(view.model, view.x, size);
    double worst = 0, lefts = 0, sizes = 0;
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        if (view.model.pinned[i] || touches(view, i))
            continue;
        const double mass = view.model.mass[i];
        const glm::dvec3 elastic = (force[i] - gas[i]) / mass - view.model.gravity;
        const glm::dvec3 inertia = (moved[i] - guess[i]) / (h * h);
        worst = std::max(worst, glm::length(inertia - elastic) / (gravity > 0 ? gravity : 1.0));
        lefts += mass * glm::length(inertia - elastic);
        sizes += mass * glm::length(inertia) + size[i];
    }
    out.primal_residual = worst;
    out.imbalance = sizes > 0 ? lefts / sizes : 0;
}

void measure_residuals(const View& view, StepReport& out)
{
    out.primal_residual = out.dual_residual = -1;
    const auto& sets = view.plan.constraints;
    const bool kept = std::all_of(sets.begin(), sets.end(), [](const ConstraintSet& s) {
        return s.multipliers != kNoBuffer && (s.kind == "distance" || s.kind == "bending");
    });
    const bool limited = // by forces that are on no record
        std::any_of(view.plan.effects.begin(), view.plan.effects.end(),
                    [](const EffectCost& e) { return e.name == "strain_limit" || e.name == "attachment"; });
    const MethodKind kind = method_of(view.world.scene());
    if ((kind == MethodKind::implicit_euler || kind == MethodKind::vbd) && !limited)
        implicit_residual(view, out);
    const bool by_multipliers = kind == MethodKind::xpbd && kept;
    if (!by_multipliers || limited || view.plan.predicted == kNoBuffer || view.world.steps() == 0)
        return;
    const double h = view.plan.timestep / view.plan.substeps;
    const std::vector<glm::dvec3> moved = view.world.displacements(), guess = view.world.predictions();
    std::vector<glm::dvec3> impulse(view.x.size(), glm::dvec3(0));
    out.stretch_residual = distance_residual(view, h, impulse);
    out.dual_residual = std::max(out.stretch_residual, bending_residual(view, h, impulse));
    const double gravity = glm::length(view.model.gravity);
    double worst = 0;
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        if (view.model.pinned[i] || touches(view, i))
            continue;
        const double mass = view.model.mass[i];
        const glm::dvec3 r = mass * (moved[i] - guess[i]) - impulse[i];
        worst = std::max(worst, glm::length(r) / (mass * (gravity > 0 ? gravity : 1.0) * h * h));
    }
    out.primal_residual = worst;
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
    const Soundness found = taut::judge(EnergyBudget(view.world.scene()), view.world);
    out.judged_energy = found.energy;
    out.energy_most = found.energy_most;
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
    if (report.imbalance > scene.accept.residual)
        set_status({Status::unconverged, "the solver left " + shown(100 * report.imbalance, 3) +
                                             " % of the forces, accept.residual is " +
                                             shown(100 * scene.accept.residual, 3) +
                                             " %; take more substeps or iterations"},
                   report);
}

StepReport measure(const World& world)
{
    const View view(world);
    StepReport out;
    out.step = world.steps();
    out.time = world.time();
    measure_stretch(view, out);
    measure_energy(view, out);
    measure_penetration(view, out);
    measure_momentum(view, out);
    measure_residuals(view, out);
    out.volume = measure_volume(world.scene(), view.x);
    out.torn = world.torn();
    out.position_hash = hash_of(world.state());
    out.solver = world.solver_report();
    out.active_share = world.active_share();
    judge_all(view, out);
    judge_residuals(world.scene(), out);
    return out;
}

} // namespace taut
