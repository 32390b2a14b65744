// Based on: kernels/methods/mass_spring/mass_spring.comp.
// Departures: none.
#include "taut/plan/corner_forces.hpp"

#include "taut/kernels/corner_sum.hpp"
#include "taut/kernels/mass_spring_hinge.hpp"
#include "taut/plan/added_elements.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/springs.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

namespace taut {
namespace {

constexpr std::string_view kHinges = "hinge_force";

/// Gives the elements of a kind their slots. `vertices`: of all their corners.
void add_kind(PlanBuilder& b, ForceBuffers::Kind kind, std::span<const std::uint32_t> vertices)
{
    ForceBuffers& f = forces(b);
    kind.first = static_cast<std::uint32_t>(f.slot_vertex.size());
    kind.count = static_cast<std::uint32_t>(vertices.size()) / kind.corners;
    f.slot_vertex.insert(f.slot_vertex.end(), vertices.begin(), vertices.end());
    add_force_buffer(b, kind.effect);
    f.kinds.push_back(std::move(kind));
}

void record_kind(PlanBuilder& b, const ForceBuffers::Kind& kind, bool report)
{
    const kernels::mass_spring_hinge::Bindings<Use> uses = {.constraint = {kind.records},
                                                            .position = {b.plan.position, kind.corners},
                                                            .low = {b.plan.low, kind.corners},
                                                            .slot = {b.forces->corner_slots, kind.corners},
                                                            .events = {b.plan.events, 0}};
    b.dispatch_by_name(kind.effect, kind.kernel, "", uses, {kind.count, kind.first, report}, kind.count);
}

/// Those of Taut's own hinges, or all others.
void record_kinds(PlanBuilder& b, bool hinges, bool report)
{
    for (const ForceBuffers::Kind& kind : forces(b).kinds)
        if ((kind.effect == kHinges) == hinges)
            record_kind(b, kind, report);
}

} // namespace

void prepare_hinge_force(PlanBuilder& b)
{
    const std::vector<BendElement> hinges = all_hinges(b);
    if (hinges.empty())
        return;
    ForceBuffers::Kind kind{std::string(kHinges), "mass_spring_hinge", kNoBuffer, 4, 0, 0};
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        kind.records = b.add_buffer<layout::BendingConstraint<Real>>(
            kHinges, "hinges", records_of(hinges, bending_record<Real>));
    });
    add_kind(b, std::move(kind), corners_of(hinges));
}

void prepare_added_forces(PlanBuilder& b)
{
    for (const AddedSet& set : added_sets(b))
    {
        const std::string& name = set.kind->name;
        const std::uint32_t records = b.add_buffer<std::byte>(name, name + " constraints", set.records);
        add_kind(b, {name, "mass_spring_" + name, records, set.kind->corners, 0, 0}, set.vertices);
    }
}

void prepare_corner_sum(PlanBuilder& b)
{
    ForceBuffers& f = forces(b);
    if (f.kinds.empty())
        return;
    const Incidence at = incidence_of(b.plan.vertex_count, f.slot_vertex, 1);
    for (std::uint32_t v = 0; v < b.plan.vertex_count; ++v)
        if (at.start[v + 1] - at.start[v] > kMaxLoopTrips)
            throw Error(ErrorCode::limit, std::to_string(at.start[v + 1] - at.start[v]) +
                                              " hinges and added elements meet at one vertex, at most " +
                                              std::to_string(kMaxLoopTrips) + " fit one invocation");
    constexpr std::string_view kName = "corner_sum";
    f.corner_slots = b.add_buffer(kName, "slots of corners", f.slot_vertex.size() * 4 * b.real_size());
    f.corner_start = b.add_buffer<std::uint32_t>(kName, "corners at a vertex, start", at.start);
    f.corner_incident = b.add_buffer<std::uint32_t>(kName, "corners at a vertex", at.entries);
}

void record_hinge_force(PlanBuilder& b, const Moment& m) { record_kinds(b, true, report_now(b, m)); }
void record_hinge_force_after(PlanBuilder& b, const Moment&) { record_kinds(b, true, false); }
void record_added_forces(PlanBuilder& b, const Moment& m) { record_kinds(b, false, report_now(b, m)); }
void record_added_forces_after(PlanBuilder& b, const Moment&) { record_kinds(b, false, false); }

void record_corner_sum(PlanBuilder& b, const Moment&)
{
    const ForceBuffers& f = forces(b);
    if (f.kinds.empty())
        return;
    const std::uint32_t n = b.plan.vertex_count, each = per_vertex(b, f.slot_vertex.size());
    const kernels::corner_sum::Bindings<Use> uses = {.start = {f.corner_start},
                                                     .incident = {f.corner_incident, each},
                                                     .slot = {f.corner_slots, each},
                                                     .force = {f.force}};
    b.dispatch("corner_sum", "", uses, {n, f.springs > 0 ? 1u : 0u}, n);
}

} // namespace taut
