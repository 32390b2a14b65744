#include "taut/plan/faces.hpp"

#include "taut/kernels/face_cuboid.hpp"
#include "taut/kernels/face_move.hpp"
#include "taut/plan/collider_shapes.hpp"
#include "taut/plan/springs.hpp"
#include "taut/scene/faces.hpp"

#include <algorithm>
#include <string>

namespace taut {
namespace {

/// Means of pushes that were found at once are less than what each triangle needs. docs/contact.md,
/// "Colliders and triangles", has what fewer and more of them leave.
constexpr std::uint32_t kFaceSweeps = 4;

/// Of the colliders of a kind, those that the surface of any body meets.
std::vector<std::uint32_t> listed_colliders(const Scene& scene, ColliderKind kind)
{
    std::vector<std::uint32_t> out;
    std::uint32_t number = 0;
    for (const Collider& c : scene.colliders)
        if (c.kind == kind)
        {
            if (std::any_of(scene.bodies.begin(), scene.bodies.end(),
                            [&](const Body& b) { return meets_surface(b, c); }))
                out.push_back(number);
            ++number;
        }
    return out;
}

/// The triangles, as three plan vertices each, of every body whose surface meets any collider of a kind.
std::vector<std::uint32_t> face_corners(const PlanBuilder& b, ColliderKind kind)
{
    std::vector<std::uint32_t> out;
    const auto& colliders = b.scene.colliders;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        if (std::any_of(colliders.begin(), colliders.end(), [&](const Collider& c) {
                return c.kind == kind && meets_surface(b.scene.bodies[body], c);
            }))
            for (const auto& triangle : b.scene.bodies[body].mesh.triangles)
                for (const std::uint32_t v : triangle)
                    out.push_back(b.vertex(body, v));
    return out;
}

} // namespace

void prepare_faces(PlanBuilder& b, ColliderKind kind)
{
    const std::vector<std::uint32_t> which = listed_colliders(b.scene, kind), corners = face_corners(b, kind);
    if (corners.empty())
        return;
    const std::string_view effect = collider_shape(kind).name;
    Incidence at = triangles_at(b, effect, corners);
    for (std::uint32_t& entry : at.entries)
        entry = 4 * (entry / 3) + entry % 3; // a triangle has four slots
    FaceBuffers& f = b.faces[static_cast<std::size_t>(kind)];
    f.triangles = static_cast<std::uint32_t>(corners.size() / 3);
    f.listed = static_cast<std::uint32_t>(which.size());
    f.corners = b.add_buffer<std::uint32_t>(effect, "triangles that meet it", corners);
    f.which = b.add_buffer<std::uint32_t>(effect, "which of them triangles meet", which);
    f.slots = b.add_buffer(effect, "ways of corners", f.triangles * std::uint64_t(16) * b.real_size());
    f.state = b.add_buffer(effect, "whether triangles were pushed", f.triangles * sizeof(std::uint32_t));
    f.near = b.add_buffer(effect, "vertices near it", b.plan.vertex_count * sizeof(std::uint32_t));
    f.start = b.add_buffer<std::uint32_t>(effect, "corners at a vertex, start", at.start);
    f.incident = b.add_buffer<std::uint32_t>(effect, "corners at a vertex", at.entries);
}

void record_faces(PlanBuilder& b, const Moment& moment, ColliderKind kind)
{
    const FaceBuffers& f = b.faces[static_cast<std::size_t>(kind)];
    if (f.triangles == 0)
        return;
    const std::string name(collider_shape(kind).name);
    const kernels::face_cuboid::Bindings<Use> push = {
        .corner = {f.corners, 3},
        .position = {b.plan.position, 3},
        .delta = {b.plan.delta, 3},
        .collider = {b.plan.colliders[static_cast<std::size_t>(kind)], 0},
        .which = {f.which, 0},
        .step_values = {b.plan.step_values, 0},
        .slot = {f.slots, 4},
        .state = {f.state}};
    const kernels::face_move::Bindings<Use> move = {.start = {f.start, 2},
                                                    .incident = {f.incident, 6},
                                                    .slot = {f.slots, 6},
                                                    .state = {f.state, 6},
                                                    .delta = {b.plan.delta},
                                                    .near = {f.near}};
    for (std::uint32_t sweep = 0; sweep < kFaceSweeps; ++sweep)
    {
        const bool look = moment.substep == 0 && moment.iteration == 0 && sweep == 0;
        b.dispatch_by_name(name, "face_" + name, "", push,
                           {f.triangles, collider_count(b.scene, kind), f.listed, moment.substep,
                            b.plan.substeps, look, sweep > 0},
                           f.triangles);
        b.dispatch(name, "", move, {b.plan.vertex_count, look}, b.plan.vertex_count);
    }
}

} // namespace taut
