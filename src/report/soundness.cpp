#include "taut/report/soundness.hpp"

#include "taut/plan/methods.hpp"
#include "taut/report/is_finite.hpp"
#include "taut/report/strained.hpp"
#include "taut/report/time_series.hpp"
#include "taut/report/volume.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

Soundness found(Status status, std::string reason)
{
    Soundness out;
    out.status = status;
    out.reason = std::move(reason);
    return out;
}

double kinetic_energy(const PhysicalModel& model, std::span<const glm::dvec3> v)
{
    double out = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (!model.pinned[i])
            out += 0.5 * model.mass[i] * glm::dot(v[i], v[i]);
    return out;
}

Soundness judge_places(const RunState& state)
{
    for (std::size_t i = 0; i < state.x.size(); ++i)
    {
        if (!is_finite(state.x[i]) || !is_finite(state.v[i]))
            return found(Status::non_finite, "vertex " + std::to_string(i) + " is not finite");
        if (glm::length(state.x[i]) > kDivergedExtent)
            return found(Status::diverged, "vertex " + std::to_string(i) + " is " +
                                               shown(glm::length(state.x[i]), 3) + " m from the origin");
    }
    return {};
}

Soundness judge_strain(const Strained& strain, double accepted)
{
    const auto beyond = [&](double value, const char* what) {
        return found(Status::unconverged, std::string(what) + " " + shown_percent(value) +
                                              ", accept.stretch is " + shown_percent(accepted) +
                                              "; take more substeps or iterations");
    };
    if (strain.kept_strain > accepted)
        return beyond(strain.kept_strain, "a spring that the method keeps at its length is stretched by");
    if (strain.limit_strain > accepted)
        return beyond(strain.limit_strain, "beyond its strain_limit, a spring is stretched by");
    if (strain.active_strain > accepted)
        return beyond(strain.active_strain, "beyond activate_strain, a spring is stretched by");
    if (strain.kept_volume > accepted)
        return beyond(strain.kept_volume, "a volume that the method keeps is off by");
    return {};
}

Soundness judge_inverted(const RunState& state)
{
    const VolumeReport volume = measure_volume(state.scene, state.x);
    if (volume.inverted <= state.scene.accept.inverted)
        return {};
    return found(Status::unconverged,
                 std::to_string(volume.inverted) + " tetrahedra are inverted, accept.inverted is " +
                     std::to_string(state.scene.accept.inverted) +
                     "; take more substeps or iterations, or stiffer material where its loads crush it");
}

/// A surface that is inside out encloses nothing that a gas could push on; nor does torn cloth, which is not
/// judged.
Soundness judge_inside_out(const PhysicalModel& model, const RunState& state)
{
    if (state.x.size() != model.mass.size())
        return {};
    for (const GasElement& e : model.gases)
    {
        const double share = enclosed_volume(e.triangles, state.x) / e.rest_volume;
        if (share < -state.scene.accept.stretch)
            return found(Status::unconverged,
                         "closed cloth with a pressure is inside out: it encloses " + shown(share, 3) +
                             " of its volume at rest, -accept.stretch is " +
                             shown(-state.scene.accept.stretch, 3) +
                             "; give it less suction, more stiffness, or contact with itself");
    }
    return {};
}

/// Constraint enforcement keeps lengths by their rates: after a step that was solved no spring changes its
/// length much. Root mean square over springs, of their lengths, in a substep.
double length_change(const PhysicalModel& model, const RunState& state)
{
    double changes = 0, lengths = 0;
    for (const StretchElement& e : model.springs)
    {
        const glm::dvec3 way = state.x[e.a] - state.x[e.b];
        const double length = glm::length(way);
        if (!(length > 0))
            continue;
        const double change = glm::dot(way, state.v[e.a] - state.v[e.b]) / length * state.drive.substep;
        changes += change * change;
        lengths += e.rest_length * e.rest_length;
    }
    return lengths > 0 ? std::sqrt(changes / lengths) : 0;
}

/// Lengths are kept by solving for their rates, not by sweeps over places.
bool enforces_rates(const Scene& scene)
{
    const MethodKind kind = scene.method.type;
    return kind == MethodKind::implicit_constraints || kind == MethodKind::acad;
}

Soundness judge_rates(const PhysicalModel& model, const RunState& state)
{
    if (!enforces_rates(state.scene))
        return {};
    const double change = length_change(model, state), accepted = state.scene.accept.stretch;
    if (change <= accepted)
        return {};
    return found(Status::unconverged, "springs change their length by " + shown_percent(change) +
                                          " in a substep, accept.stretch is " + shown_percent(accepted) +
                                          "; take more substeps");
}

Soundness judge_energy(double energy, double most, double bound, Status status, const char* what)
{
    if (energy <= bound)
        return {};
    const std::string put_in = most > 0 ? "no more than " + shown(most, 3) + " J" : "none";
    return found(status,
                 std::string(what) + " " + shown(energy, 3) + " J; " + put_in + " can have been put in");
}

/// Under implicit_constraints the count is of springs whose ends passed each other further than the solve can
/// follow.
Soundness judge_turned(const Scene& scene, double turned, double vertex_substeps)
{
    double vertices = 0, springs = 0;
    for (const Body& body : scene.bodies)
    {
        vertices += static_cast<double>(body.mesh.positions.size());
        springs += turned > 0 ? static_cast<double>(stretch_elements(body).size()) : 0;
    }
    if (!(turned * vertices > kTurnedShare * springs * vertex_substeps))
        return {};
    const double share = springs > 0 ? turned * vertices / (springs * vertex_substeps) : 1;
    return found(Status::unconverged,
                 "in a substep " + shown_percent(share) +
                     " of all springs turned too far for the solve (speed_clamp), up to " +
                     shown_percent(kTurnedShare) + " are accepted; take more substeps");
}

} // namespace

int rank(Status status)
{
    switch (status)
    {
    case Status::completed:
    case Status::interrupted: return 0;
    case Status::unconverged: return 1;
    case Status::diverged: return 2;
    default: return 3;
    }
}

Soundness worse(const Soundness& a, const Soundness& b)
{
    return rank(b.status) > rank(a.status) ? b : a;
}

Soundness judge_clamps(const Scene& scene, const Events& events, double vertex_substeps)
{
    const double clamped = static_cast<double>(events.speed_clamped);
    const MethodKind kind = scene.method.type;
    if (kind == MethodKind::implicit_constraints)
        return judge_turned(scene, clamped, vertex_substeps);
    if (kind == MethodKind::acad)
        return {}; // there the count is of turned springs, too
    if (scene.max_speed <= 0 && clamped > 0) // the guard against overflow
        return found(Status::diverged, "speeds passed what float can square " +
                                           std::to_string(events.speed_clamped) + " times");
    if (clamped > kClampedShare * vertex_substeps)
        return found(Status::unconverged,
                     "max_speed cut " + shown(100 * clamped / vertex_substeps, 3) +
                         " % of all speeds; raise it, or find what makes them");
    return {};
}

Soundness judge_counts(const Scene& scene, const Events& events, double vertex_substeps)
{
    if (events.non_finite > 0)
        return found(Status::non_finite,
                     "displacements were not finite " + std::to_string(events.non_finite) + " times");
    return judge_clamps(scene, events, vertex_substeps);
}

Soundness judge_motion(const EnergyBudget& budget, const RunState& state)
{
    const Soundness places = judge_places(state);
    if (!places.sound())
        return places;
    const EnergyMost most = budget.most(state.x, state.drive);
    const double slack = budget.small() + budget.rounding(state.precision, state.drive.substep);
    const double energy = kinetic_energy(budget.model(), state.v);
    const double noise = enforces_rates(state.scene) ? 0 : kNoiseOfStrain * most.all;
    Soundness out = judge_energy(energy, most.kinetic, kDivergedKinetic * most.kinetic + noise + slack,
                                 Status::diverged, "the kinetic energy is");
    out = worse(out, judge_counts(state.scene, state.events, state.vertex_substeps));
    out.energy = energy;
    out.energy_most = most.all;
    out.energy_exact = most.exact;
    return out;
}

Soundness judge_state(const EnergyBudget& budget, const RunState& state)
{
    const Soundness motion = judge_motion(budget, state);
    if (rank(motion.status) >= rank(Status::diverged))
        return motion;
    const Strained strain = strained(budget.model(), state);
    const double most = motion.energy_most, energy = motion.energy + strain.energy;
    const double slack = budget.small() + budget.rounding(state.precision, state.drive.substep);
    const char* what = "the kinetic energy and that of what is strained beyond accept.stretch are";
    Soundness out = judge_energy(energy, most, kDivergedEnergy * (most + slack), Status::diverged, what);
    out = worse(out, motion);
    out = worse(out, judge_strain(strain, state.scene.accept.stretch));
    out = worse(out, judge_inverted(state));
    out = worse(out, judge_inside_out(budget.model(), state));
    out = worse(out, judge_rates(budget.model(), state));
    const double bound = kUnconvergedEnergy * most + slack;
    out = worse(out, judge_energy(energy, most, bound, Status::unconverged, what));
    out =
        worse(out, judge_energy(strain.slight_energy, most, kSlightEnergy * most + slack, Status::unconverged,
                                "the energy of tetrahedra strained beyond a tenth of accept.stretch is"));
    out.energy = energy;
    out.energy_most = most;
    out.energy_exact = motion.energy_exact;
    return out;
}

} // namespace taut
