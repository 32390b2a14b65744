// The table of effects: what a step can contain, when a scene calls for it, what it adds.

#include "taut/kernels/damping.hpp"
#include "taut/kernels/external_force.hpp"
#include "taut/kernels/pin_motion.hpp"
#include "taut/plan/acad.hpp"
#include "taut/plan/added_elements.hpp"
#include "taut/plan/builder.hpp"
#include "taut/plan/colliders.hpp"
#include "taut/plan/constraints.hpp"
#include "taut/plan/contact.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/plan/corner_forces.hpp"
#include "taut/plan/guarantee.hpp"
#include "taut/plan/implicit_constraints.hpp"
#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/limits.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/momentum.hpp"
#include "taut/plan/motion.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/plan/plasticity.hpp"
#include "taut/plan/plate.hpp"
#include "taut/plan/pressure.hpp"
#include "taut/plan/solid.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/plan/surface_volume.hpp"
#include "taut/plan/vbd.hpp"
#include "taut/plan/wind.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

// ---------------------------------------------------------------- forces

void record_damping(PlanBuilder& b, const Moment&)
{
    const kernels::damping::Bindings<Use> uses = {.velocity = {b.plan.velocity},
                                                  .step_values = {b.plan.step_values, 0}};
    b.dispatch("damping", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void prepare_external_force(PlanBuilder& b)
{
    b.plan.force = b.add_buffer("external_force", "force", b.plan.vertex_count * 4 * b.real_size());
}

void record_external_force(PlanBuilder& b, const Moment&)
{
    const kernels::external_force::Bindings<Use> uses = {.position = {b.plan.position},
                                                         .force = {b.plan.force},
                                                         .velocity = {b.plan.velocity},
                                                         .step_values = {b.plan.step_values, 0}};
    b.dispatch("external_force", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

// ---------------------------------------------------------------- held vertices that move

bool wants_pin_motion(const Scene& scene)
{
    for (const Body& body : scene.bodies)
        for (const Pin& pin : body.pins)
            if (is_led(pin) && !pin.vertices.empty())
                return true;
    return false;
}

constexpr double kRounding = 1e-9; ///< of a coordinate, and of a metre

/// Of pins that are led elsewhere at time 0 than where their vertices start.
void warn_of_jumps(PlanBuilder& b)
{
    std::uint64_t count = 0;
    double furthest = 0;
    for (const MovingPin& moving : b.plan.moving_pins)
    {
        const Pin& pin = b.scene.bodies[moving.body].pins[moving.pin];
        if (pin.moved_by_program)
            continue;
        const double jump = glm::distance(held_at(pin, 0, moving.own, moving.rest), b.start[moving.vertex]);
        count += jump > kRounding * (1 + glm::length(moving.rest)) ? 1 : 0;
        furthest = std::max(furthest, jump);
    }
    if (count > 0)
        b.plan.warnings.push_back(
            {"conflict", count,
             "vertices that pins lead (" + std::to_string(count) + ") start up to " + shown(furthest, 3) +
                 " m from where the motion begins, and jump there in the first substep; let the motion "
                 "begin without a displacement"});
}

void prepare_pin_motion(PlanBuilder& b)
{
    std::vector<bool> taken(b.plan.vertex_count, false); // the first pin of a vertex wins
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t body = 0; body < b.scene.bodies.size(); ++body)
        for (std::uint32_t p = 0; p < b.scene.bodies[body].pins.size(); ++p)
        {
            const Pin& pin = b.scene.bodies[body].pins[p];
            for (std::uint32_t own = 0; own < pin.vertices.size(); ++own)
            {
                const std::uint32_t v = b.vertex(body, pin.vertices[own]);
                const glm::dvec3& rest = held_rest_of(b.scene.bodies[body])[pin.vertices[own]];
                const bool moves = !taken[v] && is_led(pin);
                taken[v] = true;
                if (!moves)
                    continue;
                b.plan.moving_pins.push_back({v, body, p, rest, own});
                vertices.push_back(v);
            }
        }
    warn_of_jumps(b);
    b.pin_vertices = b.add_buffer<std::uint32_t>("pin_motion", "pin vertices", vertices);
    b.plan.pin_targets = b.add_buffer("pin_motion", "pin targets", vertices.size() * 8 * b.real_size());
    b.plan.buffers[b.plan.pin_targets].host_written = true;
}

void record_pin_motion(PlanBuilder& b, const Moment& moment)
{
    const auto count = static_cast<std::uint32_t>(b.plan.moving_pins.size());
    const kernels::pin_motion::Bindings<Use> uses = {.vertex = {b.pin_vertices},
                                                     .pin_target = {b.plan.pin_targets, 2},
                                                     .position = {b.plan.position},
                                                     .delta = {b.plan.delta}};
    b.dispatch("pin_motion", "", uses, {count, moment.substep, b.plan.substeps}, count);
}

// ---------------------------------------------------------------- what a scene has

bool any_stretch(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), has_springs);
}

bool any_bending(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return resists_bending(b.material) && !b.mesh.triangles.empty();
    });
}

/// Elements that hand their forces to corner_sum.
bool any_corners(const Scene& scene) { return any_bending(scene) || wants_added_elements(scene); }

bool any_volume(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), holds_volumes);
}

bool any_solid(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), is_elastic);
}

bool any_elements(const Scene& scene) { return any_stretch(scene) || any_bending(scene); }

bool any_blocks(const Scene& scene)
{
    return any_elements(scene) || any_volume(scene) || any_solid(scene) || wants_added_elements(scene);
}

constexpr MethodSet kSweeps = only(MethodKind::xpbd) | only(MethodKind::pbd);
constexpr MethodSet kDescents = only(MethodKind::vbd) | only(MethodKind::implicit_euler);
constexpr MethodSet kVbd = only(MethodKind::vbd);
constexpr MethodSet kMassSpring = only(MethodKind::mass_spring);
constexpr MethodSet kConstraints = only(MethodKind::implicit_constraints);
constexpr MethodSet kAcad = only(MethodKind::acad);

/// Up to the colliders, which come from the table of their shapes.
constexpr Effect kEffectsBefore[] = {
    {"motion", Stage::force, wants_coast, nullptr, record_coast},
    {"damping", Stage::force, [](const Scene& s) { return has_bodies(s) && s.damping > 0; }, nullptr,
     record_damping},
    {"external_force", Stage::force, [](const Scene& s) { return has_bodies(s) && s.external_forces; },
     prepare_external_force, record_external_force},
    {"wind", Stage::force, wants_wind, prepare_wind, record_wind},
    {"pressure", Stage::force, wants_pressure, prepare_pressure, record_pressure},
    {"acad", Stage::force, any_stretch, prepare_acad, record_acad_forces, kAcad},
    {"spring_force", Stage::force, any_stretch, prepare_spring_force, record_spring_force,
     kMassSpring | kConstraints},
    {"hinge_force", Stage::force, any_bending, prepare_hinge_force, record_hinge_force, kMassSpring | kAcad},
    {"added_elements", Stage::force, wants_added_elements, prepare_added_forces, record_added_forces,
     kMassSpring},
    {"corner_sum", Stage::force, any_corners, prepare_corner_sum, record_corner_sum, kMassSpring | kAcad},
    {"force_kick", Stage::force, [](const Scene& s) { return has_bodies(s) && wants_kick(s); },
     prepare_force_kick, record_force_kick, kMassSpring | kConstraints | kAcad},
    {"motion", Stage::predict, has_bodies, prepare_motion, record_predict},
    {"pin_motion", Stage::hold, wants_pin_motion, prepare_pin_motion, record_pin_motion},
    // Both go by the inertial guess, which a method's own start takes back.
    {"contact", Stage::start, wants_contact, prepare_contact, record_contact_search},
    {"guarantee", Stage::start, wants_guarantee, prepare_guarantee, record_guarantee_anchor},
    {"vbd_start", Stage::start, any_blocks, prepare_vbd, record_vbd_start, kVbd},
    {"vbd_solve", Stage::solve, any_blocks, nullptr, record_vbd_solve, kVbd},
    {"momentum", Stage::solve, wants_momentum, prepare_momentum, record_momentum_start, kSweeps},
    {"distance", Stage::solve, any_stretch, prepare_distance, record_distance, only(MethodKind::xpbd)},
    {"bending", Stage::solve, any_bending, prepare_bending, record_bending, only(MethodKind::xpbd)},
    {"volume", Stage::solve, any_volume, prepare_volume, record_volume, only(MethodKind::xpbd)},
    {"neo_hookean", Stage::solve, any_solid, prepare_neo_hookean, record_neo_hookean, only(MethodKind::xpbd)},
    {"added_elements", Stage::solve, wants_added_elements, prepare_added_elements, record_added_elements,
     kSweeps}, // on account of each kind
    {"surface_volume", Stage::solve, any_surface_volume, prepare_surface_volume, record_surface_volume,
     kMassSpring},
    {"pbd_stretch", Stage::solve,
     [](const Scene& s) { return pbd_is_coloured(s) && s.method.stretch > 0 && any_stretch(s); },
     prepare_pbd_stretch, record_pbd_stretch, only(MethodKind::pbd)},
    {"pbd_bend", Stage::solve,
     [](const Scene& s) { return pbd_is_coloured(s) && s.method.bend > 0 && any_bending(s); },
     prepare_pbd_bend, record_pbd_bend, only(MethodKind::pbd)},
    {"pbd_volume", Stage::solve,
     [](const Scene& s) { return pbd_is_coloured(s) && s.method.volume > 0 && any_volume(s); },
     prepare_pbd_volume, record_pbd_volume, only(MethodKind::pbd)},
    {"pbd_jacobi", Stage::solve,
     [](const Scene& s) {
         return !pbd_is_coloured(s) &&
                ((s.method.stretch > 0 && any_stretch(s)) || (s.method.bend > 0 && any_bending(s)) ||
                 (s.method.volume > 0 && any_volume(s)));
     },
     prepare_pbd_jacobi, record_pbd_jacobi, only(MethodKind::pbd)},
    {"momentum", Stage::solve, wants_momentum, nullptr, record_momentum_end, kSweeps},
    {"implicit_constraints", Stage::solve, any_stretch, prepare_implicit_constraints,
     record_implicit_constraints, kConstraints},
    {"implicit_euler", Stage::start, any_blocks, prepare_implicit_euler, record_implicit_start,
     only(MethodKind::implicit_euler)},
    {"implicit_euler", Stage::solve, any_blocks, nullptr, record_implicit_step,
     only(MethodKind::implicit_euler)},
    {"acad", Stage::solve, any_stretch, nullptr, record_acad_solve, kAcad},
    // Before the limits: what they move is no energy that the sweeps have made.
    {"vbd_start", Stage::contact, any_blocks, nullptr, record_vbd_end, kVbd},
    {"strain_limit", Stage::contact, wants_strain_limit, prepare_strain_limit, record_strain_limit},
    {"attachment", Stage::contact, wants_attachment, prepare_attachment, record_attachment},
    {"momentum", Stage::contact, wants_momentum, prepare_momentum, record_momentum_end, kDescents},
    {"contact", Stage::contact, wants_contact, nullptr, record_contact},
    // After the pushes of surfaces: a body that only they carry starts as one that falls, and weighs all it
    // does.
    {"vbd_start", Stage::contact, any_blocks, nullptr, record_vbd_mark, kVbd},
    {"friction", Stage::contact, wants_friction, prepare_friction, nullptr}, // a variant of the passes below
};

/// After the colliders.
constexpr Effect kEffectsAfter[] = {
    {"guarantee", Stage::finish, wants_guarantee, nullptr, record_guarantee},
    {"motion", Stage::finish, has_bodies, nullptr, record_finish},
    {"plasticity", Stage::after, wants_plasticity, prepare_plasticity, record_plasticity,
     kMassSpring | only(MethodKind::xpbd) | only(MethodKind::implicit_euler) | kVbd},
    {"plate", Stage::after, wants_plate, prepare_plate, record_plate, only(MethodKind::xpbd)},
    {"tearing", Stage::after, wants_tearing, prepare_tearing, record_tearing},
    {"vbd_start", Stage::after, any_blocks, nullptr, record_vbd_share, kVbd},
    {"spring_force", Stage::after, [](const Scene& s) { return any_stretch(s) && wants_forces_after(s); },
     nullptr, record_spring_force_after, kMassSpring},
    {"hinge_force", Stage::after, [](const Scene& s) { return any_bending(s) && wants_forces_after(s); },
     nullptr, record_hinge_force_after, kMassSpring},
    {"added_elements", Stage::after,
     [](const Scene& s) { return wants_added_elements(s) && wants_forces_after(s); }, nullptr,
     record_added_forces_after, kMassSpring},
    {"corner_sum", Stage::after, [](const Scene& s) { return any_corners(s) && wants_forces_after(s); },
     nullptr, record_corner_sum, kMassSpring},
    {"force_kick", Stage::after, [](const Scene& s) { return has_bodies(s) && wants_kick_after(s); }, nullptr,
     record_force_kick_after, kMassSpring},
};

} // namespace

std::span<const Effect> effect_table()
{
    static const std::vector<Effect> table = [] {
        std::vector<Effect> all(std::begin(kEffectsBefore), std::end(kEffectsBefore));
        const auto colliders = collider_effects();
        all.insert(all.end(), colliders.begin(), colliders.end());
        all.insert(all.end(), std::begin(kEffectsAfter), std::end(kEffectsAfter));
        return all;
    }();
    return table;
}

} // namespace taut
