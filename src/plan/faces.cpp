#include "taut/plan/faces.hpp"

#include "taut/kernels/face_cuboid.hpp"
#include "taut/kernels/face_move.hpp"
#include "taut/plan/collider_shapes.hpp"
#include "taut/plan/springs.hpp"
#include "taut/scene/faces.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace taut {
namespace {

/// The triangles that meet any collider of a kind, as kernels/collide/face.comp reads them.
struct FaceLists
{
    std::vector<std::uint32_t> vertices; ///< three a triangle, in the plan
    std::vector<std::uint32_t> corners;  ///< the same, and where its bits begin
    std::vector<std::uint32_t> which;    ///< those that any meets, then 32 of them a word for each body
    std::uint32_t listed = 0;            ///< of `which`
};

/// Which colliders of a kind the surface of a body meets, in their order.
std::vector<bool> met_by(const Scene& scene, const Body& body, ColliderKind kind)
{
    std::vector<bool> out;
    SurfaceRule rule(body);
    for (const Collider& c : scene.colliders)
        if (c.kind == kind)
            out.push_back(rule.meets(c));
    return out;
}

/// Fills the list, and returns where the bits of each body begin behind it.
std::vector<std::optional<std::uint32_t>> list_colliders(FaceLists& out,
                                                         const std::vector<std::vector<bool>>& met)
{
    for (std::uint32_t c = 0; c < met[0].size(); ++c)
        if (std::any_of(met.begin(), met.end(), [&](const std::vector<bool>& m) { return m[c]; }))
            out.which.push_back(c);
    out.listed = static_cast<std::uint32_t>(out.which.size());
    std::vector<std::optional<std::uint32_t>> begin;
    for (const std::vector<bool>& m : met)
    {
        begin.emplace_back();
        if (std::find(m.begin(), m.end(), true) == m.end())
            continue;
        const std::size_t first = out.which.size();
        begin.back() = static_cast<std::uint32_t>(first) - out.listed;
        out.which.resize(first + (out.listed + 31) / 32, 0);
        for (std::uint32_t k = 0; k < out.listed; ++k)
            out.which[first + k / 32] |= std::uint32_t(m[out.which[k]]) << (k % 32);
    }
    return begin;
}

FaceLists face_lists(const PlanBuilder& b, ColliderKind kind)
{
    FaceLists out;
    std::vector<std::vector<bool>> met;
    for (const Body& body : b.scene.bodies)
        met.push_back(met_by(b.scene, body, kind));
    const auto begin = list_colliders(out, met);
    for (std::size_t body = 0; body < begin.size(); ++body)
        for (std::size_t t = 0; begin[body] && t < b.scene.bodies[body].mesh.triangles.size(); ++t)
        {
            for (const std::uint32_t v : b.scene.bodies[body].mesh.triangles[t])
            {
                out.vertices.push_back(b.vertex(body, v));
                out.corners.push_back(b.vertex(body, v));
            }
            out.corners.push_back(*begin[body]);
        }
    return out;
}

/// A triangle: of its corners, and of each listed collider.
std::uint32_t slots_each(const FaceBuffers& f) { return 3 + f.listed; }

} // namespace

void prepare_faces(PlanBuilder& b, ColliderKind kind)
{
    const FaceLists lists = face_lists(b, kind);
    if (lists.corners.empty())
        return;
    const std::string_view effect = collider_shape(kind).name;
    FaceBuffers& f = b.faces[static_cast<std::size_t>(kind)];
    f.triangles = static_cast<std::uint32_t>(lists.corners.size() / 4);
    f.listed = lists.listed;
    const std::uint32_t each = slots_each(f);
    Incidence at = triangles_at(b, effect, lists.vertices);
    for (std::uint32_t& entry : at.entries)
        entry = each * (entry / 3) + entry % 3;
    f.corners = b.add_buffer<std::uint32_t>(effect, "triangles that meet it", lists.corners);
    f.which = b.add_buffer<std::uint32_t>(effect, "which of them triangles meet", lists.which);
    f.slots = b.add_buffer(effect, "ways of corners", std::uint64_t(f.triangles) * each * 4 * b.real_size());
    f.state = b.add_buffer(effect, "whether triangles were pushed", f.triangles * sizeof(std::uint32_t));
    f.near = b.add_buffer(effect, "vertices near it", b.plan.vertex_count * sizeof(std::uint32_t));
    f.start = b.add_buffer<std::uint32_t>(effect, "corners at a vertex, start", at.start);
    f.incident = b.add_buffer<std::uint32_t>(effect, "corners at a vertex", at.entries);
}

void record_faces(PlanBuilder& b, const Moment& moment, const ColliderPush& way, ColliderKind kind)
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
        .slot = {f.slots, slots_each(f)},
        .state = {f.state}};
    const kernels::face_move::Bindings<Use> move = {.start = {f.start, 2},
                                                    .incident = {f.incident, 6},
                                                    .slot = {f.slots, 6},
                                                    .state = {f.state, 6},
                                                    .delta = {b.plan.delta},
                                                    .near = {f.near}};
    for (std::uint32_t sweep = 0; sweep < way.face_sweeps; ++sweep)
    {
        const bool first = way.first && sweep == 0, look = first && moment.substep == 0;
        b.dispatch_by_name(name, "face_" + name, "", push,
                           {f.triangles, collider_count(b.scene, kind), f.listed, moment.substep,
                            b.plan.substeps, look, first, sweep > 0},
                           f.triangles);
        b.dispatch(name, "", move, {b.plan.vertex_count, slots_each(f), look}, b.plan.vertex_count);
    }
}

} // namespace taut
