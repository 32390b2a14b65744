// The volume within closed surfaces as one implicit constraint each.
//
// Based on: kernels/volume/surface_volume_sum.comp, surface_volume_apply.comp.
// Departures: none beyond those named there.

#include "taut/plan/surface_volume.hpp"

#include "taut/kernels/surface_volume_apply.hpp"
#include "taut/kernels/surface_volume_sum.hpp"
#include "taut/plan/springs.hpp"
#include "taut/plan/surface.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

namespace taut {
namespace {

constexpr const char* kSurfaceVolumeEffect = "surface_volume";
constexpr std::uint32_t kVertices = 2 * TAUT_LINEAR_GROUP; ///< of a group of a small surface
constexpr std::uint32_t kMostGroups = 1024;                ///< of a surface

std::vector<std::array<std::uint32_t, 3>> in_plan_vertices(const PlanBuilder& b, std::size_t body)
{
    auto triangles = b.scene.bodies[body].mesh.triangles;
    for (auto& t : triangles)
        for (std::uint32_t& v : t)
            v = b.vertex(body, v);
    return triangles;
}

void check_trips(const PlanBuilder& b, std::size_t body, const Incidence& at, std::uint32_t chunk,
                 std::string_view setting)
{
    for (std::uint32_t v = 0; v < b.plan.vertex_count; ++v)
        if (std::uint64_t(at.start[v + 1] - at.start[v]) * (chunk / TAUT_LINEAR_GROUP) > kMaxLoopTrips)
            throw Error(ErrorCode::limit,
                        "bodies[" + std::to_string(body) +
                            "]: " + std::to_string(at.start[v + 1] - at.start[v]) +
                            " triangles meet at one vertex, too many for one invocation to "
                            "gather; set " +
                            std::string(setting) + " to 0, or take a finer mesh there");
}

void add_surface(const PlanBuilder& b, std::size_t body, std::string_view setting, SurfaceTables& out)
{
    const auto triangles = in_plan_vertices(b, body);
    std::vector<std::uint32_t> flat;
    for (const auto& t : triangles)
        flat.insert(flat.end(), t.begin(), t.end());
    const Incidence at = incidence_of(b.plan.vertex_count, flat, 3);
    const auto first = static_cast<std::uint32_t>(out.vertices.size() / 2);
    for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
    {
        if (at.start[v] == at.start[v + 1])
            continue; // within the solid
        out.vertices.insert(out.vertices.end(), {v, static_cast<std::uint32_t>(out.corners.size() / 2)});
        for (std::uint32_t k = at.start[v]; k < at.start[v + 1]; ++k)
        {
            const auto& t = triangles[at.entries[k] / 3];
            const std::uint32_t corner = at.entries[k] % 3;
            out.corners.insert(out.corners.end(), {t[(corner + 1) % 3], t[(corner + 2) % 3]});
        }
    }
    const auto end = static_cast<std::uint32_t>(out.vertices.size() / 2);
    const std::uint32_t chunk = surface_chunk(end - first), count = (end - first + chunk - 1) / chunk;
    check_trips(b, body, at, chunk, setting);
    const auto from = static_cast<std::uint32_t>(out.groups.size() / 6);
    const auto surface = static_cast<std::uint32_t>(out.bodies.size());
    for (std::uint32_t v = first; v < end; v += chunk)
        out.groups.insert(out.groups.end(), {v, std::min(v + chunk, end),
                                             out.vertices[2 * std::size_t(first)], surface, from, count});
    out.bodies.push_back(body);
}

/// Whether any vertex of the surface can move.
bool moves(const PlanBuilder& b, std::size_t body)
{
    const auto& triangles = b.scene.bodies[body].mesh.triangles;
    return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
        return std::any_of(t.begin(), t.end(),
                           [&](std::uint32_t v) { return b.inverse_mass[b.vertex(body, v)] > 0; });
    });
}

} // namespace

bool any_surface_volume(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), holds_surface_volume);
}

std::uint32_t surface_chunk(std::uint32_t vertices)
{
    const std::uint32_t least = (vertices + kMostGroups - 1) / kMostGroups;
    const std::uint32_t rounded = (least + TAUT_LINEAR_GROUP - 1) / TAUT_LINEAR_GROUP * TAUT_LINEAR_GROUP;
    return std::max(kVertices, rounded);
}

SurfaceTables surface_tables(const PlanBuilder& b, bool (*wanted)(const Body&), std::string_view setting)
{
    SurfaceTables out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        if (wanted(b.scene.bodies[body]) && moves(b, body))
            add_surface(b, body, setting, out);
    out.vertices.insert(out.vertices.end(), {0, static_cast<std::uint32_t>(out.corners.size() / 2)});
    return out;
}

void add_surface_tables(PlanBuilder& b, std::string_view effect, const SurfaceTables& tables,
                        SurfaceBuffers& s)
{
    s.groups = static_cast<std::uint32_t>(tables.groups.size() / 6);
    s.surfaces = static_cast<std::uint32_t>(tables.bodies.size());
    s.vertices = static_cast<std::uint32_t>(tables.vertices.size() / 2 - 1);
    if (s.groups == 0)
        return;
    std::vector<std::uint32_t> words = tables.groups;
    words.insert(words.end(), tables.vertices.begin(), tables.vertices.end());
    s.table = b.add_buffer<std::uint32_t>(effect, "surface groups and vertices", words);
    s.corners = b.add_buffer<std::uint32_t>(effect, "corners at a vertex", tables.corners);
    s.gradient = b.add_buffer(effect, "volume gradients", std::uint64_t(s.vertices) * 4 * b.real_size());
    s.partials = b.add_buffer(effect, "volume sums", std::uint64_t(s.groups) * 3 * b.real_size());
}

void record_surface_sums(PlanBuilder& b, std::string_view effect, const SurfaceBuffers& s, bool further)
{
    const auto each = static_cast<std::uint32_t>(b.plan.buffers[s.corners].bytes / 4 / s.vertices + 1);
    const kernels::surface_volume_sum::Bindings<Use> sums = {.table = {s.table, 2},
                                                             .corner = {s.corners, each},
                                                             .position = {b.plan.position, 1 + each},
                                                             .low = {b.plan.low, 1 + each},
                                                             .delta = {b.plan.delta, 1 + each},
                                                             .gradient = {s.gradient},
                                                             .partials = {s.partials}};
    b.dispatch(effect, "", sums, {s.groups, further}, s.groups, s.vertices);
}

void prepare_surface_volume(PlanBuilder& b)
{
    const SurfaceTables tables = surface_tables(b, holds_surface_volume, "volume_stiffness");
    SurfaceBuffers& s = b.surfaces;
    add_surface_tables(b, kSurfaceVolumeEffect, tables, s);
    if (s.groups == 0)
        return;
    std::vector<double> held;
    for (const std::size_t body : tables.bodies)
    {
        const SurfaceElement element = surface_element(b.scene.bodies[body]);
        held.insert(held.end(), {element.rest_volume, element.compliance});
    }
    with_real(b.plan.precision, [&](auto zero) {
        const std::vector<decltype(zero)> values(held.begin(), held.end());
        s.values = b.add_buffer<decltype(zero)>(kSurfaceVolumeEffect, "volumes at rest", values);
    });
    bool soft = false;
    for (std::size_t k = 1; k < held.size(); k += 2)
        soft = soft || held[k] > 0;
    if (soft && b.plan.iterations > 1) // what the iterations before have pulled with
        s.multiplier = b.add_buffer(kSurfaceVolumeEffect, "volume multipliers",
                                    std::uint64_t(b.plan.iterations + 1) * s.surfaces * b.real_size());
}

void record_surface_volume(PlanBuilder& b, const Moment& moment)
{
    const SurfaceBuffers& s = b.surfaces;
    if (s.groups == 0)
        return;
    record_surface_sums(b, kSurfaceVolumeEffect, s, moment.iteration > 0);
    kernels::surface_volume_apply::Bindings<Use> moved = {.table = {s.table, 2},
                                                          .surface = {s.values},
                                                          .gradient = {s.gradient},
                                                          .partials = {s.partials},
                                                          .step_values = {b.plan.step_values, 0},
                                                          .delta = {b.plan.delta},
                                                          .events = {b.plan.events, 0}};
    const bool kept = s.multiplier != kNoBuffer;
    if (kept)
        moved.multiplier = {s.multiplier};
    b.dispatch(kSurfaceVolumeEffect, kept ? "kept" : "", moved,
               {s.groups, s.surfaces, moment.iteration, moment.last}, s.groups, s.vertices);
}

} // namespace taut
