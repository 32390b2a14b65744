// Where a substep of vertex block descent begins and ends: the start and its history, the guard that takes
// the fallback where the start would raise the incremental potential, and the shift that keeps momentum.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024, section 3.7 (the starts).
// Departures: the guard and the shift (docs/methods/vbd.md).

#include "taut/plan/vbd.hpp"

#include "taut/kernels/vbd_choose.hpp"
#include "taut/kernels/vbd_drift.hpp"
#include "taut/kernels/vbd_limit.hpp"
#include "taut/kernels/vbd_mark.hpp"
#include "taut/kernels/vbd_rise.hpp"
#include "taut/kernels/vbd_share.hpp"
#include "taut/kernels/vbd_shift.hpp"
#include "taut/kernels/vbd_start.hpp"
#include "taut/plan/body_parts.hpp"

#include "taut/kernels/shared/vbd_parts.h"

#include <algorithm>

namespace taut {
namespace {

bool adaptive(const PlanBuilder& b) { return b.scene.method.start == "adaptive"; }

/// 2 * body + 1 for bodies with held vertices, by vertex.
std::vector<std::uint32_t> support_of(const PlanBuilder& b)
{
    std::vector<std::uint32_t> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const std::uint32_t first = b.plan.body_start[body], end = b.plan.body_start[body + 1];
        const bool held = std::any_of(b.inverse_mass.begin() + first, b.inverse_mass.begin() + end,
                                      [](double w) { return !(w > 0); });
        out.insert(out.end(), end - first, 2 * static_cast<std::uint32_t>(body) + (held ? 1 : 0));
    }
    return out;
}

/// "inertial" is the start as published, for comparison; from "previous" sweeps can only lower the potential.
bool guarded(const PlanBuilder& b) { return adaptive(b); }

std::string variant_of(const BlockBuffers& f)
{
    return f.elastic ? "elastic" : f.volumes ? "volumes" : f.hinges ? "hinges" : "";
}

void record_rise(PlanBuilder& b, bool ended)
{
    const BlockBuffers& f = *b.blocks;
    const std::uint32_t near = 1 + f.near();
    std::vector<Use> uses = {{f.row, f.row_words()}, {f.ends, f.springs_each}, {b.plan.position, near},
                             {b.plan.low, near},     {b.plan.predicted},       {b.plan.delta, near},
                             {f.sums, 0}};
    if (f.corners != kNoBuffer)
        uses.push_back({f.corners, f.corners_each()});
    b.dispatch("vbd_start", "vbd_rise", variant_of(f), uses,
               kernels::vbd_rise::Params{f.groups, ended ? 1u : 0u, f.table}, f.groups, f.rows);
}

/// No start above the fallback.
void record_guard(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer)
        return;
    record_rise(b, false);
    const Use uses[] = {{f.row, 1}, {b.plan.low}, {f.sums, 0}, {b.plan.delta}, {b.plan.step_values, 0}};
    b.dispatch("vbd_start", "vbd_choose", "", uses,
               kernels::vbd_choose::Params{f.groups, f.table, f.row_words()}, f.groups, f.rows);
}

/// No end that makes energy.
void record_limit(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer)
        return;
    record_rise(b, true);
    const Use uses[] = {{f.row, 1}, {b.plan.low}, {f.sums, 0}, {b.plan.delta}};
    b.dispatch("vbd_start", "vbd_limit", "", uses,
               kernels::vbd_limit::Params{f.groups, f.table, f.row_words()}, f.groups, f.rows);
}

void record_shift(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer || !f.loose)
        return;
    const std::uint32_t words = f.row_words();
    std::vector<Use> sum = {{f.row, 1}, {b.plan.predicted}, {b.plan.delta}, {f.sums, 0}, {b.plan.position}};
    std::vector<Use> uses = {{f.row, 1}, {f.sums, 0}, {b.plan.delta}, {b.plan.position}};
    const bool contact = f.seen != kNoBuffer;
    if (contact)
    {
        sum.push_back({f.solved});
        uses.push_back({f.seen, 0});
    }
    b.dispatch("vbd_start", "vbd_drift", contact ? "contact" : "", sum,
               kernels::vbd_drift::Params{f.groups, f.table, words}, f.groups, f.rows);
    b.dispatch("vbd_start", "vbd_shift", contact ? "contact" : "", uses,
               kernels::vbd_shift::Params{f.groups, f.table, words}, f.groups, f.rows);
}

} // namespace

std::vector<std::uint32_t> guard_table(const PlanBuilder& b, BlockBuffers& f,
                                       std::span<const GuardedRow> row_of)
{
    BodyParts parts;
    for (std::size_t body = 0; guarded(b) && body < b.scene.bodies.size(); ++body)
    {
        const std::uint32_t first = b.plan.body_start[body], end = b.plan.body_start[body + 1];
        std::vector<std::uint32_t> rows, elements;
        for (std::uint32_t v = first; v < end; ++v)
            if (row_of[v].row != kNoRow)
            {
                rows.push_back(row_of[v].row);
                elements.push_back(row_of[v].elements);
            }
        const bool held = rows.size() < end - first;
        parts.add(rows, elements, held);
        f.loose |= !held && !rows.empty();
    }
    f.groups = parts.groups();
    return parts.words();
}

void prepare_vbd_start(PlanBuilder& b, BlockBuffers& f)
{
    if (guarded(b))
        f.sums =
            b.add_buffer("vbd_start", "sums of the rise",
                         (std::uint64_t(f.groups) * std::max(TAUT_VBD_SUMS, TAUT_VBD_DRIFT) + TAUT_VBD_FALL) *
                             b.real_size());
    const std::uint64_t n = b.plan.vertex_count;
    if (adaptive(b) || !f.omega.empty())
        f.support = b.add_buffer<std::uint32_t>("vbd_start", "support", support_of(b));
    if (!adaptive(b))
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        const std::vector<Real> whole(n, Real(1));
        f.share = b.add_buffer<Real>("vbd_start", "share of gravity", whole);
    });
    b.plan.kept.push_back(f.share);
    if (b.scene.colliders.empty())
        return;
    f.touched = b.add_buffer("vbd_start", "touched", b.scene.bodies.size() * sizeof(std::uint32_t));
    f.seen = b.add_buffer("vbd_start", "touched before", n * 2 * sizeof(std::uint32_t));
    f.solved = b.add_buffer("vbd_start", "displacement before contact", n * 4 * b.real_size());
    b.plan.kept.insert(b.plan.kept.end(), {f.touched, f.seen});
    if (f.loose) // what contacts pushed in the substep before is for vbd_shift
        b.plan.kept.push_back(f.solved);
}

void record_vbd_start(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0)
        return;
    const bool previous = b.scene.method.start == "previous", contact = f.touched != kNoBuffer;
    std::vector<Use> uses = {{b.plan.position}, {b.plan.predicted}, {b.plan.delta}, {b.plan.step_values, 0}};
    if (previous)
        uses.push_back({b.plan.low});
    if (adaptive(b))
        uses.push_back({f.share});
    if (contact)
        uses.insert(uses.end(), {{f.support}, {f.touched}, {f.seen, 2}});
    b.dispatch("vbd_start", "vbd_start",
               previous      ? "previous"
               : contact     ? "contact"
               : adaptive(b) ? "adaptive"
                             : "",
               uses, kernels::vbd_start::Params{b.plan.vertex_count}, b.plan.vertex_count);
    record_guard(b);
}

void record_vbd_end(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0)
        return;
    record_limit(b);
    record_shift(b);
    if (f.solved == kNoBuffer)
        return;
    const Use uses[] = {{b.plan.delta}, {f.solved}};
    b.dispatch("vbd_start", "vbd_mark", "", uses, kernels::vbd_mark::Params{b.plan.vertex_count},
               b.plan.vertex_count);
}

void record_vbd_share(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0 || !adaptive(b))
        return;
    std::vector<Use> uses = {
        {b.plan.predicted}, {b.plan.delta}, {f.support}, {f.share}, {b.plan.step_values, 0}};
    if (f.solved != kNoBuffer)
        uses.insert(uses.end(), {{f.solved}, {f.touched, 0}});
    b.dispatch("vbd_start", "vbd_share", f.solved != kNoBuffer ? "contact" : "", uses,
               kernels::vbd_share::Params{b.plan.vertex_count}, b.plan.vertex_count);
}

} // namespace taut
