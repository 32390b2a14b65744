#include "taut/plan/colliders.hpp"

#include "taut/kernels/collide_distance_field.hpp"
#include "taut/plan/collider_shapes.hpp"
#include "taut/plan/contact_scene.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace taut {
namespace {

template <ColliderKind Kind>
bool wanted(const Scene& scene)
{
    return has_bodies(scene) && std::any_of(scene.colliders.begin(), scene.colliders.end(),
                                            [](const Collider& c) { return c.kind == Kind; });
}

/// Whether colliders push between the sweeps of contact, too: what lies on cloth on a collider is carried
/// through both.
bool push_within_contact(const PlanBuilder& b)
{
    return wants_contact(b.scene) && b.scene.contact.sweeps > 1;
}

bool has_friction(const Scene& scene, ColliderKind kind)
{
    return std::any_of(scene.colliders.begin(), scene.colliders.end(),
                       [&](const Collider& c) { return c.kind == kind && c.friction > 0; });
}

template <ColliderKind Kind>
void prepare(PlanBuilder& b)
{
    const ColliderShape& shape = collider_shape(Kind);
    const std::uint64_t records =
        std::uint64_t(shape.copies(b.plan.substeps)) * collider_count(b.scene, Kind);
    const std::uint32_t id =
        b.add_buffer(shape.name, std::string(shape.name) + "s", records * shape.bytes(b.plan.precision));
    b.plan.buffers[id].host_written = true;
    b.plan.colliders[static_cast<std::size_t>(Kind)] = id;
    if (shape.values)
        with_real(b.plan.precision, [&](auto zero) {
            const std::vector<float> given = collider_values(b.scene);
            const std::vector<decltype(zero)> all(given.begin(), given.end());
            b.collider_values[static_cast<std::size_t>(Kind)] =
                b.add_buffer(shape.name, "values of " + std::string(shape.name) + "s", std::span(all));
        });
    prepare_faces(b, Kind);
}

/// Kernels of all shapes have one interface; that with values is the widest.
void record(PlanBuilder& b, const Moment& moment, const ColliderPush& push, ColliderKind kind)
{
    const auto row = static_cast<std::size_t>(kind);
    const std::uint32_t colliders = collider_count(b.scene, kind);
    const kernels::collide_distance_field::Bindings<Use> uses = {
        .position = {b.plan.position},
        .delta = {b.plan.delta},
        .collider = {b.plan.colliders[row], 0},
        .step_values = {b.plan.step_values, 0},
        .events = {b.plan.events, 0},
        .values = {b.collider_values[row], kFarValues},
        .contact = {b.friction_taken[row], colliders}};
    const bool kept = uses.contact.is_set();
    const std::string_view variant = !b.friction[row] ? "" : kept ? "friction_kept" : "friction";
    b.dispatch_by_name(
        collider_shape(kind).name, collider_shape(kind).kernel, variant, uses,
        {b.plan.vertex_count, colliders, moment.substep, b.plan.substeps, push.first, push.report},
        b.plan.vertex_count);
    record_faces(b, moment, push, kind);
}

template <ColliderKind Kind>
void record_kind(PlanBuilder& b, const Moment& moment)
{
    const bool first = moment.iteration == 0 && !push_within_contact(b);
    record(b, moment, {first, moment.last, kFaceSweeps}, Kind);
}

template <std::size_t... Kinds>
std::array<Effect, kColliderKinds> make_effects(std::index_sequence<Kinds...>)
{
    return {{{collider_shape(ColliderKind(Kinds)).name, Stage::contact, wanted<ColliderKind(Kinds)>,
              prepare<ColliderKind(Kinds)>, record_kind<ColliderKind(Kinds)>}...}};
}

} // namespace

bool has_bodies(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [](const Body& b) { return !b.mesh.positions.empty(); });
}

std::span<const Effect, kColliderKinds> collider_effects()
{
    static const auto effects = make_effects(std::make_index_sequence<kColliderKinds>());
    return effects;
}

bool wants_friction(const Scene& scene)
{
    return has_bodies(scene) && std::any_of(scene.colliders.begin(), scene.colliders.end(),
                                            [](const Collider& c) { return c.friction > 0; });
}

void prepare_friction(PlanBuilder& b)
{
    for (std::size_t row = 0; row < kColliderKinds; ++row)
    {
        const auto kind = static_cast<ColliderKind>(row);
        b.friction[row] = has_friction(b.scene, kind);
        const bool often =
            (b.plan.iterations > 1 && b.method.contact_each_iteration) || push_within_contact(b);
        if (b.friction[row] && often)
            b.friction_taken[row] = b.add_buffer(
                "friction", std::string(collider_shape(kind).name) + " friction",
                std::uint64_t(collider_count(b.scene, kind)) * b.plan.vertex_count * 4 * b.real_size());
    }
}

void record_colliders(PlanBuilder& b, const Moment& moment, const ColliderPush& push)
{
    for (std::size_t row = 0; row < kColliderKinds; ++row)
        if (b.plan.colliders[row] != kNoBuffer)
            record(b, moment, push, static_cast<ColliderKind>(row));
}

} // namespace taut
