// Forces that are left in M (x - x~) / h^2 = f(x) after the last substep, in fp64 on the host.
//
// Based on: Martin et al. Example-Based Elastic Materials. SIGGRAPH 2011, eq. 2 (implicit Euler as a
//   minimum).
// Departures: dampers are springs to what was before the substep (below). Vertices that touch a collider are
//   left out, whose contact forces are on no record.

#include "taut/report/implicit_residual.hpp"

#include "taut/plan/methods.hpp"
#include "taut/report/contact_depth.hpp"
#include "taut/report/energy_budget.hpp"
#include "taut/report/load_residual.hpp"
#include "taut/report/touching.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace taut {
namespace {

using reference::View;

/// m/s^2: where there is no gravity, what bodies would weigh tells how stiff they are, and how long a fall
/// through their size takes.
constexpr double kWeight = 9.81;

/// Springs nearer to their limit than this share of it may have been pulled back by it.
constexpr double kNearLimit = 0.9;

struct Substep
{
    /// With dampers as springs: that of the view, which outlives it, where there are none.
    std::shared_ptr<const PhysicalModel> model;
    std::vector<glm::dvec3> moved, inertia; ///< m; (x - x~) / h^2, m/s^2
    std::vector<glm::dvec3> gas;            ///< N, a part of what x~ was pushed with
    Leftover left;
};

/// A damper of c N s/m adds the force c/h e to a spring, e what the substep made it longer: together they are
/// a spring of k + c/t with the rest length at which that gives the force of both, t (s) the time in which
/// the body has to answer: h, or under xpbd longer, in which dampers give way. implicit_euler takes e along
/// the present direction, vbd as the difference of lengths.
std::shared_ptr<const PhysicalModel> with_dampers_as_springs(const View& view,
                                                             const std::vector<glm::dvec3>& moved, double h,
                                                             double time)
{
    const auto damped = [](const StretchElement& e) { return e.damping > 0; };
    if (std::none_of(view.model.springs.begin(), view.model.springs.end(), damped))
        return {std::shared_ptr<void>(), &view.model};
    auto model = std::make_shared<PhysicalModel>(view.model);
    const bool by_length = view.world.scene().method.type == MethodKind::vbd;
    for (StretchElement& e : model->springs)
    {
        const glm::dvec3 d = view.x[e.a] - view.x[e.b], change = moved[e.a] - moved[e.b];
        const double length = glm::length(d);
        if (!(e.damping > 0 && length > 0 && e.compliance > 0))
            continue;
        const double longer = by_length ? length - glm::length(d - change) : glm::dot(change, d) / length;
        const double stiffness = 1 / e.compliance, drag = e.damping / h;
        const double pull = stiffness * (length - e.rest_length) + drag * longer;
        e.compliance = 1 / (stiffness + e.damping / time);
        e.rest_length = length - pull * e.compliance;
    }
    return model;
}

/// `time` in s, in which bodies have to answer; 0: the substep.
std::optional<Substep> last_substep(const View& view, double time = 0)
{
    const std::vector<glm::dvec3> guess = view.world.predictions();
    const std::vector<bool>& flows = view.model.flows;
    if (guess.empty() || std::find(flows.begin(), flows.end(), false) == flows.end())
        return std::nullopt;
    const std::size_t count = view.x.size();
    const double h = view.plan.timestep / view.plan.substeps;
    Substep out{nullptr, view.world.displacements(), {}, {}, {}};
    out.model = with_dampers_as_springs(view, out.moved, h, time > 0 ? time : h);
    std::vector<glm::dvec3> force(count, glm::dvec3(0)), gas(count, glm::dvec3(0));
    add_forces(*out.model, view.x, force);
    for (const GasElement& e : out.model->gases) // of the guess, which it has pushed
        add_gas_forces(e, view.x, gas);
    out.left.force.resize(count);
    out.left.load.resize(count);
    out.left.touches.resize(count);
    out.left.time = time > 0 ? time : h;
    for (std::size_t i = 0; i < count; ++i)
    {
        const double mass = out.model->mass[i];
        const glm::dvec3 elastic = force[i] - gas[i] - mass * out.model->gravity;
        out.inertia.push_back((out.moved[i] - guess[i]) / (h * h));
        out.left.force[i] = mass * out.inertia[i] - elastic;
    }
    out.gas = std::move(gas);
    return out;
}

/// Marks the ends of springs that a strain limit may have moved.
void mark_limited(const View& view, std::vector<bool>& marks)
{
    const auto& bodies = view.world.scene().bodies;
    for (const StretchElement& e : view.model.springs)
    {
        const auto& starts = view.model.body_start;
        const auto next = std::upper_bound(starts.begin(), starts.end(), e.a);
        const double limit =
            bodies[static_cast<std::size_t>(next - starts.begin()) - 1].material.strain_limit;
        const double length = glm::distance(view.x[e.a], view.x[e.b]);
        if (limit > 0 && length > (1 + kNearLimit * limit) * e.rest_length)
            marks[e.a] = marks[e.b] = true;
    }
}

} // namespace

bool has_effect(const View& view, std::string_view name)
{
    return std::any_of(view.plan.effects.begin(), view.plan.effects.end(),
                       [&](const EffectCost& e) { return e.name == name; });
}

void measure_implicit_residual(const View& view, StepReport& out)
{
    const std::optional<Substep> last = last_substep(view);
    if (!last)
        return;
    const double gravity = glm::length(last->model->gravity);
    std::vector<double> size(view.x.size(), 0.0);
    add_force_sizes(*last->model, view.x, size);
    const std::vector<bool> touches = touching_colliders(view.world.scene(), view.world.scene().colliders,
                                                         view.model, view.x, view.world.time());
    double worst = 0, lefts = 0, sizes = 0;
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        if (last->model->pinned[i] || last->model->flows[i] || touches[i])
            continue;
        const double mass = last->model->mass[i], left = glm::length(last->left.force[i]);
        worst = std::max(worst, left / mass / (gravity > 0 ? gravity : 1.0));
        lefts += left;
        sizes += mass * glm::length(last->inertia[i]) + size[i];
    }
    out.primal_residual = worst;
    out.imbalance = sizes > 0 ? lefts / sizes : 0;
}

namespace {

std::size_t body_of(const PhysicalModel& model, std::uint32_t vertex)
{
    const auto next = std::upper_bound(model.body_start.begin(), model.body_start.end(), vertex);
    return static_cast<std::size_t>(next - model.body_start.begin()) - 1;
}

/// Which vertices have an element with one that touches, and do not touch themselves.
std::vector<bool> beside(const PhysicalModel& model, const std::vector<bool>& touches)
{
    std::vector<bool> out(touches.size(), false);
    const auto spread = [&](const auto& corners) {
        if (std::any_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return touches[v]; }))
            for (const std::uint32_t v : corners)
                out[v] = !touches[v];
    };
    for (const StretchElement& e : model.springs)
        spread(std::array{e.a, e.b});
    for (const BendElement& e : model.hinges)
        spread(std::array{e.edge0, e.edge1, e.wing0, e.wing1});
    for (const VolumeElement& e : model.volumes)
        spread(e.vertex);
    for (const SolidElement& e : model.solids)
        spread(e.vertex);
    for (const PlateHinge& h : model.plates)
        spread(std::array{h.element.edge0, h.element.edge1, h.element.wing0, h.element.wing1});
    for (const AddedElement& e : model.added)
        spread(std::span(e.vertex).first(e.kind->corners));
    return out;
}

/// m/s^2, of each body: the least that its vertices are loaded with. A body without weight that nothing
/// drives is held to what it would weigh; one that wind or forces drive has to answer to these however weak
/// they are, down to what the last digits of places make of a substep (as EnergyBudget::rounding has them).
std::vector<double> least_loads(const View& view, double substep)
{
    const Scene& scene = view.world.scene();
    const double gravity = glm::length(view.model.gravity);
    std::vector<double> out;
    for (const Body& body : scene.bodies)
    {
        const bool blown =
            view.plan.wind != kNoBuffer && body.material.drag + body.material.friction_drag > 0;
        const bool driven = (blown || scene.external_forces) && scene.method.type != MethodKind::xpbd;
        const double rounded = rounded_way(view.plan.precision, view.model.diameter) / (substep * substep);
        out.push_back(gravity > 0 ? gravity : driven ? rounded : kWeight);
    }
    return out;
}

/// m/s^2: what elements have answered, but, under xpbd, to gases: that is held against what these move.
glm::dvec3 answered(const View& view, const Substep& last, std::size_t vertex)
{
    const bool apart = view.world.scene().method.type == MethodKind::xpbd;
    return last.inertia[vertex] + (apart ? last.gas[vertex] / last.model->mass[vertex] : glm::dvec3(0));
}

/// Puts loads and touches of all vertices into `last`.
void put_loads(const View& view, Substep& last)
{
    const double h = view.plan.timestep / view.plan.substeps, gravity = glm::length(view.model.gravity);
    const std::vector<double> least = least_loads(view, h);
    std::vector<double> ways;
    for (std::size_t b = 0; b < least.size(); ++b)
        for (std::size_t i = view.model.body_start[b]; i < view.model.body_start[b + 1]; ++i)
        {
            const double own = glm::length(answered(view, last, i));
            last.left.load[i] = last.model->mass[i] * std::max(least[b], own);
            // One that a collider pushed may have left it in the same substep.
            ways.push_back(glm::length(last.moved[i]) + gravity * h * h);
        }
    last.left.touches = touching_colliders(view.world.scene(), view.world.scene().colliders, view.model,
                                           view.x, view.world.time(), ways);
    for (std::size_t i = 0; i < ways.size(); ++i)
        last.left.touches[i] = last.left.touches[i] || view.model.flows[i];
    mark_limited(view, last.left.touches);
    const std::vector<bool> met = in_contact(view.world);
    for (std::size_t i = 0; i < met.size(); ++i)
        last.left.touches[i] = last.left.touches[i] || met[i];
    last.left.beside = beside(*last.model, last.left.touches);
    if (!last.model->gases.empty())
        last.left.gas = last.gas;
}

/// Bodies with forces that are on no record, or that join far vertices.
std::vector<bool> unjudged_bodies(const View& view)
{
    const PhysicalModel& model = view.model;
    std::vector<bool> out(model.body_start.size() - 1, false);
    const auto mark = [&](std::uint32_t vertex) { out[body_of(model, vertex)] = true; };
    const auto mark_rigid = [&](const auto& elements, const auto& first) {
        for (const auto& e : elements)
            if (!(e.compliance > 0))
                mark(first(e));
    };
    mark_rigid(model.springs, [](const StretchElement& e) { return e.a; });
    mark_rigid(model.hinges, [](const BendElement& e) { return e.edge0; });
    mark_rigid(model.volumes, [](const VolumeElement& e) { return e.vertex[0]; });
    for (const SurfaceElement& e : model.surfaces)
        mark(e.triangles.at(0)[0]);
    const auto& bodies = view.world.scene().bodies;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        out[b] = out[b] || bodies[b].material.attachment_slack;
    return out;
}

/// `model` without the elements of bodies of which nothing can be said; their vertices are as held.
PhysicalModel judged_part(const PhysicalModel& model, const std::vector<bool>& unjudged)
{
    PhysicalModel out = model;
    const auto drop = [&](auto& elements, const auto& first) {
        std::erase_if(elements, [&](const auto& e) { return unjudged[body_of(model, first(e))]; });
    };
    drop(out.springs, [](const StretchElement& e) { return e.a; });
    drop(out.hinges, [](const BendElement& e) { return e.edge0; });
    drop(out.volumes, [](const VolumeElement& e) { return e.vertex[0]; });
    drop(out.solids, [](const SolidElement& e) { return e.vertex[0]; });
    drop(out.gases, [](const GasElement& e) { return e.triangles.at(0)[0]; });
    drop(out.added, [](const AddedElement& e) { return e.vertex[0]; });
    out.surfaces.clear(); // plates stay: they know each other by their places, and held vertices need none
    for (std::uint32_t i = 0; i < out.pinned.size(); ++i)
        out.pinned[i] = out.pinned[i] || unjudged[body_of(model, i)];
    return out;
}

} // namespace

LoadResidual measure_load_residual(const World& world)
{
    View view(world);
    view.distance = std::vector<reference::DistanceRecord>(); // the matrix takes their room
    view.v = std::vector<glm::dvec3>();
    const MethodKind kind = world.scene().method.type;
    const bool sweeps = kind == MethodKind::xpbd;
    if (kind != MethodKind::implicit_euler && kind != MethodKind::vbd && !sweeps)
        return {};
    const std::vector<bool> unjudged = unjudged_bodies(view);
    if (std::all_of(unjudged.begin(), unjudged.end(), [](bool b) { return b; }))
        return {};
    const double gravity = glm::length(view.model.gravity);
    const double fall = std::sqrt(view.model.diameter / (gravity > 0 ? gravity : kWeight)); // s
    std::optional<Substep> last = last_substep(view, sweeps ? fall : 0);
    if (!last)
        return {};
    put_loads(view, *last);
    if (std::find(unjudged.begin(), unjudged.end(), true) != unjudged.end())
        last->model = std::make_shared<PhysicalModel>(judged_part(*last->model, unjudged));
    Leftover& left = last->left;
    left.against_response = sweeps;
    left.followed = kFollowedShare * world.scene().accept.residual;
    if (!sweeps)
        for (std::size_t i = 0; i < view.x.size(); ++i)
            left.carried.push_back(last->model->pinned[i] ? glm::length(last->moved[i]) : 0.0);
    return load_residual(*last->model, view.x, left);
}

} // namespace taut
