#include "taut/report/strained.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/plan/methods.hpp"
#include "taut/report/plate_energy.hpp"
#include "taut/report/time_series.hpp"
#include "taut/report/touching.hpp"
#include "taut/report/volume.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Of a scene's size: a shorter spring joins two vertices in one place, and its strain says nothing.
constexpr double kNoLength = 1e-6;

/// pbd, or a spring that is rigid, is asked to keep its length; pbd of a stiffness k below 1 to 1/k as much.
/// What two held vertices have between them is nobody's to solve.
void add_springs(const PhysicalModel& model, const RunState& state, double accepted, Strained& out)
{
    const Scene& scene = state.scene;
    const std::span<const glm::dvec3> x = state.x;
    const MethodKind kind = scene.method.type;
    const bool kept = kind == MethodKind::pbd;
    const double share = kept ? scene.method.stretch : 1;
    // Cloth that has torn since the model was made has other springs than the model.
    const bool torn = x.size() != model.mass.size();
    const std::vector<StretchElement> now = torn ? scene_springs(scene) : std::vector<StretchElement>();
    std::size_t body = 0;
    std::size_t next = scene.bodies.empty() ? 0 : scene.bodies[0].mesh.positions.size();
    std::size_t first = 0;
    for (const StretchElement& e : torn ? now : model.springs)
    {
        for (; e.a >= next; next += scene.bodies[body].mesh.positions.size())
        {
            first = next;
            ++body;
        }
        if (!(e.rest_length > 0) || (model.pinned[e.a] && model.pinned[e.b]))
            continue;
        const double stretch = glm::distance(x[e.a], x[e.b]) - e.rest_length;
        const double strain = stretch / e.rest_length;
        if (kept || !(e.compliance > 0))
            out.kept_strain = std::max(out.kept_strain, share * strain);
        else if (std::abs(strain) > accepted && !model.flows[first])
            out.energy += 0.5 * stretch * stretch / e.compliance;
        const bool may_act =
            scene.method.constrained == ConstrainedSprings::all || e.kind == SpringKind::structural;
        const bool seen = e.rest_length > kNoLength * model.diameter;
        if (kind == MethodKind::acad && may_act && seen)
            out.active_strain = std::max(out.active_strain, strain - scene.method.activate_strain);
        const double limit = scene.bodies[body].material.strain_limit;
        if (limit > 0)
            out.limit_strain = std::max(out.limit_strain, strain - limit);
    }
}

/// The volume of a tetrahedron, or within a surface, that is rigid, or kept by pbd: as springs. Of all
/// tetrahedra of a body together, by what each is off: one alone may be so for a moment.
void add_volumes(const PhysicalModel& model, const RunState& state, Strained& out)
{
    const bool pbd = state.scene.method.type == MethodKind::pbd;
    const double share = pbd ? state.scene.method.volume : 1;
    const auto kept = [&](double compliance) { return pbd || !(compliance > 0); };
    std::vector<double> off(state.scene.bodies.size()), whole(off);
    for (const VolumeElement& e : model.volumes)
    {
        const auto next = std::upper_bound(model.body_start.begin(), model.body_start.end(), e.vertex[0]);
        const auto body = static_cast<std::size_t>(next - model.body_start.begin()) - 1;
        if (!kept(e.compliance) || model.flows[e.vertex[0]])
            continue;
        off[body] += std::abs(volume_of(e.vertex, state.x) - e.rest_volume);
        whole[body] += e.rest_volume;
    }
    for (std::size_t b = 0; b < off.size(); ++b)
        if (whole[b] > 0)
            out.kept_volume = std::max(out.kept_volume, share * off[b] / whole[b]);
    for (const SurfaceElement& e : model.surfaces)
        if (kept(e.compliance))
            out.kept_volume = std::max(
                out.kept_volume, share * std::abs(enclosed_volume(e.triangles, state.x) / e.rest_volume - 1));
}

/// Of elements with stretches; those that a spring limit or a projection keeps are none of them.
void add_elements(const PhysicalModel& model, const RunState& state, double accepted, Strained& out)
{
    for (const AddedElement& e : model.added)
        if (const auto t = e.stretches(state.x); t && std::max(-(*t)[0], (*t)[1]) > accepted)
            out.energy += e.energy(state.x);
}

/// Hinges that are bent by more than accept.stretch, as an angle in rad; pbd's have no stiffness. Torn cloth
/// has other hinges than the model.
void add_hinges(const PhysicalModel& model, const RunState& state, double accepted, Strained& out)
{
    const std::span<const glm::dvec3> x = state.x;
    if (state.scene.method.type == MethodKind::pbd || x.size() != model.mass.size())
        return;
    for (const BendElement& e : model.hinges)
    {
        const bool held =
            model.pinned[e.edge0] && model.pinned[e.edge1] && model.pinned[e.wing0] && model.pinned[e.wing1];
        if (!(e.compliance > 0) || model.flows[e.edge0] || held)
            continue;
        const double turn = bend_angle(e, x);
        if (std::abs(turn) > accepted)
            out.energy += 0.5 * turn * turn / e.compliance;
    }
    const bool turned = std::any_of(model.plates.begin(), model.plates.end(), [&](const PlateHinge& h) {
        return std::abs(bend_angle(h.element, x)) > accepted;
    });
    if (turned)
        out.energy += plate_energy(model.plates, x);
}

/// All of them where bodies can meet each other or themselves, whose contacts no state tells, and where cloth
/// has torn since the model was made: then no element counts.
std::vector<bool> pushed_vertices(const PhysicalModel& model, const RunState& state)
{
    if (state.x.size() != model.mass.size() || wants_contact(state.scene))
        return std::vector<bool>(state.x.size(), true);
    return touching_colliders(state.scene, state.colliders, model, state.x, state.drive.time);
}

void add_solids(const PhysicalModel& model, const RunState& state, double accepted, Strained& out)
{
    if (state.scene.method.type == MethodKind::pbd || model.solids.empty())
        return;
    const std::vector<bool> pushed = pushed_vertices(model, state);
    for (const SolidElement& e : model.solids)
    {
        if (model.flows[e.vertex[0]])
            continue;
        const glm::dmat3 f = deformation(e, state.x);
        const glm::dmat3 green = 0.5 * (glm::transpose(f) * f - glm::dmat3(1));
        const double size = std::sqrt(glm::dot(green[0], green[0]) + glm::dot(green[1], green[1]) +
                                      glm::dot(green[2], green[2]));
        if (!(size > kSlightStrain * accepted))
            continue;
        const double energy = std::max(solid_energy(e, state.x), 0.0);
        out.energy += size > accepted ? energy : 0;
        const bool touches = std::ranges::any_of(e.vertex, [&](std::uint32_t v) { return pushed[v]; });
        out.slight_energy += touches ? 0 : energy;
    }
}

} // namespace

Strained strained(const PhysicalModel& model, const RunState& state)
{
    const double accepted = state.scene.accept.stretch;
    Strained out;
    add_springs(model, state, accepted, out);
    add_volumes(model, state, out);
    add_elements(model, state, accepted, out);
    add_hinges(model, state, accepted, out);
    add_solids(model, state, accepted, out);
    return out;
}

} // namespace taut
