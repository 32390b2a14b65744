// Where a substep of vertex block descent begins and ends: the start and its history, the guard that takes
// the fallback where the start would raise the incremental potential, as seen from what carries a body, and
// the shift that keeps momentum.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024, section 3.7 (the starts).
// Departures: the guard and the shift (docs/methods/vbd.md).

#include "taut/plan/vbd.hpp"

#include "taut/kernels/vbd_carry.hpp"
#include "taut/kernels/vbd_choose.hpp"
#include "taut/kernels/vbd_drift.hpp"
#include "taut/kernels/vbd_frame.hpp"
#include "taut/kernels/vbd_limit.hpp"
#include "taut/kernels/vbd_mark.hpp"
#include "taut/kernels/vbd_rise.hpp"
#include "taut/kernels/vbd_share.hpp"
#include "taut/kernels/vbd_shift.hpp"
#include "taut/kernels/vbd_start.hpp"
#include "taut/plan/body_parts.hpp"
#include "taut/plan/vbd_rows.hpp"

#include "taut/kernels/shared/vbd_parts.h"

#include <algorithm>

namespace taut {
namespace {

bool adaptive(const PlanBuilder& b) { return b.scene.method.start == SweepStart::adaptive; }

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
    kernels::vbd_rise::Bindings<Use> uses = {.row = {f.row, f.row_words()},
                                             .end = {f.ends, f.springs_each},
                                             .position = {b.plan.position, near},
                                             .low = {b.plan.low, near},
                                             .predicted = {b.plan.predicted},
                                             .delta = {b.plan.delta, near},
                                             .sums = {f.sums, 0}};
    if (f.corners != kNoBuffer)
        uses.corner = {f.corners, f.corners_each()};
    b.dispatch("vbd_start", variant_of(f), uses, {f.groups, ended ? 1u : 0u, f.table, f.frame()}, f.groups,
               f.rows);
    record_vbd_added_rise(b);
}

/// What carries each body, from which its energies are seen.
void record_frame(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (!f.surfaces)
        return;
    const kernels::vbd_carry::Bindings<Use> sum = {.row = {f.row, 1},
                                                   .position = {b.plan.position},
                                                   .predicted = {b.plan.predicted},
                                                   .contacts = {f.contacts, 2},
                                                   .sums = {f.sums, 0}};
    b.dispatch("vbd_start", "", sum, {f.groups, f.table, f.row_words(), f.surfaces, f.carry()}, f.groups,
               f.rows);
    const kernels::vbd_frame::Bindings<Use> fit = {.row = {f.row, 1}, .sums = {f.sums, 0}};
    b.dispatch("vbd_start", "", fit, {f.groups, f.table, f.carry()}, f.groups, f.groups);
}

/// No start above the fallback.
void record_guard(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer)
        return;
    record_frame(b);
    record_rise(b, false);
    kernels::vbd_choose::Bindings<Use> uses = {.row = {f.row, 1},
                                               .low = {b.plan.low},
                                               .sums = {f.sums, 0},
                                               .delta = {b.plan.delta},
                                               .step_values = {b.plan.step_values, 0}};
    if (f.surfaces)
        uses.position = {b.plan.position};
    b.dispatch("vbd_start", f.surfaces ? "contact" : "", uses, {f.groups, f.table, f.row_words(), f.frame()},
               f.groups, f.rows);
}

/// No end that makes energy.
void record_limit(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer)
        return;
    record_rise(b, true);
    kernels::vbd_limit::Bindings<Use> uses = {.row = {f.row, 1},
                                              .low = {b.plan.low},
                                              .sums = {f.sums, 0},
                                              .delta = {b.plan.delta},
                                              .lost = {f.lost}};
    if (f.surfaces)
        uses.position = {b.plan.position};
    b.dispatch("vbd_start", f.surfaces ? "contact" : "", uses, {f.groups, f.table, f.row_words(), f.frame()},
               f.groups, f.rows);
}

void record_shift(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    if (f.sums == kNoBuffer || !f.loose)
        return;
    const std::uint32_t words = f.row_words();
    kernels::vbd_drift::Bindings<Use> sum = {.row = {f.row, 1},
                                             .predicted = {b.plan.predicted},
                                             .delta = {b.plan.delta},
                                             .sums = {f.sums, 0},
                                             .position = {b.plan.position}};
    kernels::vbd_shift::Bindings<Use> uses = {
        .row = {f.row, 1}, .sums = {f.sums, 0}, .delta = {b.plan.delta}, .position = {b.plan.position}};
    const bool contact = f.touched != kNoBuffer;
    if (contact)
    {
        sum.push = {f.solved};
        sum.contacts = {f.contacts};
        uses.seen = {f.seen, 0};
        uses.lost = {f.lost};
    }
    b.dispatch("vbd_start", contact ? "contact" : "", sum, {f.groups, f.table, words, f.surfaces, f.frame()},
               f.groups, f.rows);
    b.dispatch("vbd_start", contact ? "contact" : "", uses, {f.groups, f.table, words, f.frame()}, f.groups,
               f.rows);
}

} // namespace

std::vector<std::uint32_t> guard_table(const PlanBuilder& b, BlockBuffers& f,
                                       std::span<const GuardedRow> row_of)
{
    BodyParts parts;
    f.group_start = {0};
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
        f.group_start.push_back(parts.groups());
        f.loose |= !held && !rows.empty();
    }
    f.groups = parts.groups();
    return parts.words();
}

void prepare_vbd_start(PlanBuilder& b, BlockBuffers& f)
{
    if (guarded(b))
    {
        const std::uint64_t frames = meets_colliders(b) ? f.groups * (TAUT_VBD_DRIFT + TAUT_VBD_FRAME) : 0;
        f.sums = b.add_buffer("vbd_start", "sums of the rise", (f.carry() + frames) * b.real_size());
        f.lost = b.add_buffer("vbd_start", "lost energy", std::max(f.groups, 1u) * b.real_size());
        b.plan.kept.push_back(f.lost);
    }
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
    if (!meets_colliders(b))
        return;
    f.touched = b.add_buffer("vbd_start", "touched", b.scene.bodies.size() * sizeof(std::uint32_t));
    f.seen = b.add_buffer("vbd_start", "touched before", n * 2 * sizeof(std::uint32_t));
    f.solved = b.add_buffer("vbd_start", "displacement before contact", n * 4 * b.real_size());
    b.plan.kept.insert(b.plan.kept.end(), {f.touched, f.seen});
    if (f.loose) // what contacts pushed in the substep before is for vbd_shift
        b.plan.kept.push_back(f.solved);
}

void record_vbd_start(PlanBuilder& b, const Moment& moment)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0)
        return;
    record_vbd_touch(b, moment);
    const bool previous = b.scene.method.start == SweepStart::previous, contact = f.touched != kNoBuffer;
    kernels::vbd_start::Bindings<Use> uses = {.position = {b.plan.position},
                                              .predicted = {b.plan.predicted},
                                              .delta = {b.plan.delta},
                                              .step_values = {b.plan.step_values, 0}};
    if (previous)
        uses.low = {b.plan.low};
    if (adaptive(b))
        uses.share = {f.share};
    if (contact)
    {
        uses.support = {f.support};
        uses.touched = {f.touched};
        uses.seen = {f.seen, 2};
    }
    b.dispatch("vbd_start",
               previous      ? "previous"
               : contact     ? "contact"
               : adaptive(b) ? "adaptive"
                             : "",
               uses, {b.plan.vertex_count}, b.plan.vertex_count);
    record_guard(b);
}

void record_vbd_end(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0)
        return;
    record_limit(b);
    record_shift(b);
}

void record_vbd_mark(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0 || f.solved == kNoBuffer)
        return;
    const kernels::vbd_mark::Bindings<Use> uses = {.delta = {b.plan.delta}, .solved = {f.solved}};
    b.dispatch("vbd_start", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void record_vbd_share(PlanBuilder& b, const Moment&)
{
    const BlockBuffers& f = *b.blocks;
    if (f.rows == 0 || !adaptive(b))
        return;
    kernels::vbd_share::Bindings<Use> uses = {.predicted = {b.plan.predicted},
                                              .delta = {b.plan.delta},
                                              .support = {f.support},
                                              .share = {f.share},
                                              .step_values = {b.plan.step_values, 0}};
    if (f.solved != kNoBuffer)
    {
        uses.solved = {f.solved};
        uses.touched = {f.touched, 0};
    }
    b.dispatch("vbd_start", f.solved != kNoBuffer ? "contact" : "", uses, {b.plan.vertex_count},
               b.plan.vertex_count);
}

} // namespace taut
