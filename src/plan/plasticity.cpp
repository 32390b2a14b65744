// Springs and tetrahedra that keep a part of their strain.
//
// Based on: kernels/plasticity/plastic_spring.comp, plastic_solid.comp.
// Departures: none beyond those named there.

#include "taut/plan/plasticity.hpp"

#include "taut/kernels/plastic_solid.hpp"
#include "taut/kernels/plastic_spring.hpp"
#include "taut/plan/constraints.hpp"
#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/plan/springs.hpp"
#include "taut/plan/vbd.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

namespace taut {
namespace {

constexpr const char* kPlasticityEffect = "plasticity";
constexpr std::uint32_t kNoSpring = 0xffffffffu;
constexpr double kAtOnce = 1e30; ///< 1/s: an infinite creep as a float

bool keeps_strain(const Body& body)
{
    return body.material.plastic_yield > 0 && (has_springs(body) || is_elastic(body));
}

/// The material of a plan vertex.
const Material& material_at(const PlanBuilder& b, std::uint32_t vertex)
{
    const auto& start = b.plan.body_start;
    const auto next = std::upper_bound(start.begin(), start.end(), vertex);
    return b.scene.bodies[static_cast<std::size_t>(next - start.begin()) - 1].material;
}

template <typename Record>
std::vector<Record> decode(const PlanBuilder& b, std::uint32_t buffer)
{
    const std::vector<std::byte>& bytes = b.plan.buffers[buffer].initial;
    std::vector<Record> out(bytes.size() / sizeof(Record));
    if (!out.empty())
        std::memcpy(out.data(), bytes.data(), out.size() * sizeof(Record));
    return out;
}

template <typename Real>
void append_rule(std::vector<Real>& out, const Material& m)
{
    for (const double value : {m.plastic_yield, std::min(m.plastic_creep, kAtOnce), m.plastic_limit})
        out.push_back(static_cast<Real>(value));
}

template <typename Record, typename Real>
void add_springs(PlanBuilder& b, Plasticity& p, std::uint32_t records)
{
    std::vector<std::uint32_t> list;
    std::vector<Real> rules;
    const std::vector<Record> all = decode<Record>(b, records);
    for (std::uint32_t k = 0; k < all.size(); ++k)
    {
        const Material& m = material_at(b, all[k].a);
        if (!(m.plastic_yield > 0) || !(all[k].rest_length > 0))
            continue;
        list.push_back(k);
        rules.push_back(all[k].rest_length);
        append_rule(rules, m);
    }
    p.springs = static_cast<std::uint32_t>(list.size());
    if (list.empty())
        return;
    p.spring_records = records;
    if (p.forces)
        b.plan.flowing = records;
    p.spring_list = b.add_buffer<std::uint32_t>(kPlasticityEffect, "springs that flow", list);
    p.spring_rules = b.add_buffer<Real>(kPlasticityEffect, "yield of springs", rules);
    b.plan.kept.push_back(records);
}

/// Where the springs of a method are, and whether as forces; kNoBuffer without any.
std::uint32_t spring_buffer(const PlanBuilder& b, bool& forces)
{
    forces = b.method.kind != MethodKind::xpbd;
    if (b.method.kind == MethodKind::vbd)
        return b.blocks ? b.blocks->ends : kNoBuffer;
    if (b.method.kind == MethodKind::implicit_euler)
        return implicit_records(b).springs;
    if (b.method.kind == MethodKind::mass_spring)
        return !b.forces ? kNoBuffer : b.forces->node_centric ? b.forces->ends : b.forces->records;
    const ConstraintSet* set = find_set(b.plan, "distance");
    return set != nullptr ? set->buffer : kNoBuffer;
}

/// Likewise their elastic tetrahedra.
std::uint32_t solid_buffer(const PlanBuilder& b)
{
    if (b.method.kind == MethodKind::vbd)
        return b.blocks && b.blocks->elastic ? b.blocks->corners : kNoBuffer;
    if (b.method.kind == MethodKind::implicit_euler)
        return implicit_records(b).solids;
    const ConstraintSet* set = find_set(b.plan, "neo_hookean");
    return set != nullptr ? set->buffer : kNoBuffer;
}

/// A tetrahedron in plan vertices, and its records.
struct Flowing
{
    SolidElement element;
    std::array<std::uint32_t, 4> record = {kNoSpring, kNoSpring, kNoSpring, kNoSpring};
};

std::vector<Flowing> all_tetrahedra(const PlanBuilder& b)
{
    std::vector<Flowing> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (const SolidElement& e : acting_solids(b, body))
            out.push_back({e, {kNoSpring, kNoSpring, kNoSpring, kNoSpring}});
    return out;
}

/// xpbd and implicit_euler: one record each, with the corners in their own order.
template <typename Real>
void find_records(const PlanBuilder& b, std::uint32_t buffer, std::vector<Flowing>& all)
{
    std::map<std::array<std::uint32_t, 4>, std::vector<std::uint32_t>> at;
    const auto records = decode<layout::SolidTetrahedron<Real>>(b, buffer);
    for (std::uint32_t k = 0; k < records.size(); ++k)
        at[{records[k].a, records[k].b, records[k].c, records[k].d}].push_back(k);
    for (Flowing& t : all)
    {
        std::vector<std::uint32_t>& list = at[t.element.vertex];
        if (list.empty())
            continue;
        t.record[1] = list.back();
        list.pop_back();
    }
}

/// vbd: one in the row of each corner that moves, behind the held volumes there (vbd_rows.cpp).
void find_corners(const PlanBuilder& b, std::vector<Flowing>& all)
{
    std::vector<SolidElement> solids;
    std::vector<VolumeElement> volumes;
    for (const Flowing& t : all)
        solids.push_back(t.element);
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        for (const VolumeElement& e : acting_volumes(b, body))
            volumes.push_back(e);
    const Incidence at = incidence_of(b.plan.vertex_count, solids);
    const Incidence held = incidence_of(b.plan.vertex_count, volumes);
    const auto row = decode<std::uint32_t>(b, b.blocks->row);
    for (std::uint32_t k = 0; k < b.blocks->rows; ++k)
    {
        const std::uint32_t v = row[5 * std::size_t(k)];
        std::uint32_t next = row[5 * std::size_t(k) + 4] + (held.start[v + 1] - held.start[v]);
        for (std::uint32_t j = at.start[v]; j < at.start[v + 1]; ++j)
            all[at.entries[j] / 4].record[at.entries[j] % 4] = next++;
    }
}

template <typename Real>
void add_solids(PlanBuilder& b, Plasticity& p)
{
    std::vector<Flowing> all = all_tetrahedra(b);
    p.solid_records = solid_buffer(b);
    if (all.empty() || p.solid_records == kNoBuffer)
        return;
    if (b.method.kind == MethodKind::vbd)
        find_corners(b, all);
    else
        find_records<Real>(b, p.solid_records, all);
    std::vector<std::uint32_t> table;
    std::vector<Real> rules, state;
    for (const Flowing& t : all)
    {
        const Material& m = material_at(b, t.element.vertex[0]);
        if (!(m.plastic_yield > 0))
            continue;
        table.insert(table.end(), t.element.vertex.begin(), t.element.vertex.end());
        table.insert(table.end(), t.record.begin(), t.record.end());
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                rules.push_back(static_cast<Real>(t.element.inverse_rest[column][row]));
        append_rule(rules, m);
        for (const int value : {1, 1, 1, 0, 0, 0})
            state.push_back(static_cast<Real>(value));
    }
    p.solids = static_cast<std::uint32_t>(table.size() / 8);
    if (p.solids == 0)
        return;
    p.solid_table = b.add_buffer<std::uint32_t>(kPlasticityEffect, "tetrahedra that flow", table);
    p.solid_rules = b.add_buffer<Real>(kPlasticityEffect, "yield of tetrahedra", rules);
    p.solid_state = b.add_buffer<Real>(kPlasticityEffect, "plastic stretch", state);
    b.plan.kept.insert(b.plan.kept.end(), {p.solid_records, p.solid_state});
}

} // namespace

bool wants_plasticity(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), keeps_strain);
}

void check_plasticity(const Scene& scene, Refusals& out)
{
    constexpr MethodKind kMethodsThatFlow[] = {MethodKind::xpbd, MethodKind::vbd, MethodKind::implicit_euler,
                                               MethodKind::mass_spring};
    std::vector<std::string_view> flowing;
    for (const MethodKind kind : kMethodsThatFlow)
        flowing.push_back(to_string(kind));
    const bool tears = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.material.tear_strain > 0; });
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        if (!keeps_strain(body))
            return;
        const std::string where = "bodies[" + std::to_string(k) + "].material.plastic_yield is not 0, but ";
        if (std::find(std::begin(kMethodsThatFlow), std::end(kMethodsThatFlow), scene.method.type) ==
            std::end(kMethodsThatFlow))
            throw Error(ErrorCode::unsupported, where + "method " + quoted(scene.method.type) +
                                                    " keeps no strain; set it to 0, or take a method of " +
                                                    scene_file::listing(flowing));
        if (tears)
            throw Error(ErrorCode::unsupported,
                        where + "a body of the scene can tear, and a tear plans the scene anew and would "
                                "forget what has flowed; set it, or tear_strain, to 0");
    });
}

void prepare_plasticity(PlanBuilder& b)
{
    b.plasticity = std::make_shared<Plasticity>();
    Plasticity& p = *b.plasticity;
    const std::uint32_t springs = spring_buffer(b, p.forces);
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        if (springs != kNoBuffer && p.forces)
            add_springs<layout::Spring<Real>, Real>(b, p, springs);
        else if (springs != kNoBuffer)
            add_springs<layout::DistanceConstraint<Real>, Real>(b, p, springs);
        add_solids<Real>(b, p);
    });
}

void record_plasticity(PlanBuilder& b, const Moment&)
{
    const Plasticity& p = *b.plasticity;
    if (p.springs > 0)
    {
        const kernels::plastic_spring::Bindings<Use> uses = {.record = {p.spring_list},
                                                             .rule = {p.spring_rules, 4},
                                                             .spring = {p.spring_records},
                                                             .position = {b.plan.position, 2},
                                                             .low = {b.plan.low, 2},
                                                             .step_values = {b.plan.step_values, 0}};
        b.dispatch(kPlasticityEffect, p.forces ? "force" : "", uses, {p.springs}, p.springs);
    }
    if (p.solids > 0)
    {
        const kernels::plastic_solid::Bindings<Use> uses = {.table = {p.solid_table, 8},
                                                            .rule = {p.solid_rules, 12},
                                                            .state = {p.solid_state, 6},
                                                            .solid = {p.solid_records, 4},
                                                            .position = {b.plan.position, 4},
                                                            .low = {b.plan.low, 4},
                                                            .step_values = {b.plan.step_values, 0}};
        b.dispatch(kPlasticityEffect, "", uses, {p.solids}, p.solids);
    }
}

} // namespace taut
