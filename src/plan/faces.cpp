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

/// The triangles that meet any collider of a kind, as kernels/collide/face.comp reads them.
struct FaceLists
{
    std::vector<std::uint32_t> vertices; ///< three a triangle, in the plan
    std::vector<std::uint32_t> corners;  ///< the same and where its list begins
    std::vector<std::uint32_t> which;    ///< of each body that has any, how many, then those of the shape
    std::uint32_t longest = 0;           ///< of the lists
};

/// Those of the colliders of a kind that the surface of a body meets.
std::vector<std::uint32_t> listed_colliders(const Scene& scene, const Body& body, ColliderKind kind)
{
    std::vector<std::uint32_t> out;
    std::uint32_t number = 0;
    SurfaceRule rule(body);
    for (const Collider& c : scene.colliders)
        if (c.kind == kind)
        {
            if (rule.meets(c))
                out.push_back(number);
            ++number;
        }
    return out;
}

FaceLists face_lists(const PlanBuilder& b, ColliderKind kind)
{
    FaceLists out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const auto listed = listed_colliders(b.scene, b.scene.bodies[body], kind);
        if (listed.empty())
            continue;
        const auto size = static_cast<std::uint32_t>(listed.size());
        const auto list = static_cast<std::uint32_t>(out.which.size());
        out.which.push_back(size);
        out.which.insert(out.which.end(), listed.begin(), listed.end());
        out.longest = std::max(out.longest, size);
        for (const auto& triangle : b.scene.bodies[body].mesh.triangles)
        {
            for (const std::uint32_t v : triangle)
            {
                out.vertices.push_back(b.vertex(body, v));
                out.corners.push_back(b.vertex(body, v));
            }
            out.corners.push_back(list);
        }
    }
    return out;
}

} // namespace

void prepare_faces(PlanBuilder& b, ColliderKind kind)
{
    const FaceLists lists = face_lists(b, kind);
    if (lists.corners.empty())
        return;
    const std::string_view effect = collider_shape(kind).name;
    FaceBuffers& f = b.faces[static_cast<std::size_t>(kind)];
    f.triangles = static_cast<std::uint32_t>(lists.corners.size() / 4);
    f.slots_each = 3 + lists.longest;
    Incidence at = triangles_at(b, effect, lists.vertices);
    for (std::uint32_t& entry : at.entries)
        entry = f.slots_each * (entry / 3) + entry % 3;
    f.corners = b.add_buffer<std::uint32_t>(effect, "triangles that meet it", lists.corners);
    f.which = b.add_buffer<std::uint32_t>(effect, "which of them triangles meet", lists.which);
    f.slots = b.add_buffer(effect, "ways of corners",
                           std::uint64_t(f.triangles) * f.slots_each * 4 * b.real_size());
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
        .corner = {f.corners, 4},
        .position = {b.plan.position, 3},
        .delta = {b.plan.delta, 3},
        .collider = {b.plan.colliders[static_cast<std::size_t>(kind)], 0},
        .which = {f.which, 0},
        .step_values = {b.plan.step_values, 0},
        .slot = {f.slots, f.slots_each},
        .state = {f.state}};
    const kernels::face_move::Bindings<Use> move = {.start = {f.start, 2},
                                                    .incident = {f.incident, 6},
                                                    .slot = {f.slots, 6},
                                                    .state = {f.state, 6},
                                                    .delta = {b.plan.delta},
                                                    .near = {f.near}};
    for (std::uint32_t sweep = 0; sweep < kFaceSweeps; ++sweep)
    {
        const bool first = moment.iteration == 0 && sweep == 0, look = first && moment.substep == 0;
        b.dispatch_by_name(name, "face_" + name, "", push,
                           {f.triangles, collider_count(b.scene, kind), f.slots_each, moment.substep,
                            b.plan.substeps, look, first, sweep > 0},
                           f.triangles);
        b.dispatch(name, "", move, {b.plan.vertex_count, f.slots_each, look}, b.plan.vertex_count);
    }
}

} // namespace taut
