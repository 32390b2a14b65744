// The passes of a substep of implicit Euler.
//
// Based on, Departures: implicit_euler.cpp.

#include "taut/plan/implicit_euler.hpp"

#include "taut/plan/implicit_system.hpp"

#include "taut/kernels/dot.hpp"
#include "taut/kernels/implicit_euler_hinge.hpp"
#include "taut/kernels/implicit_euler_rise_hinge.hpp"
#include "taut/kernels/implicit_force.hpp"
#include "taut/kernels/implicit_guess.hpp"
#include "taut/kernels/implicit_hold.hpp"
#include "taut/kernels/implicit_matrix.hpp"
#include "taut/kernels/implicit_momentum.hpp"
#include "taut/kernels/implicit_solid_blocks.hpp"
#include "taut/kernels/implicit_solids.hpp"
#include "taut/kernels/implicit_start.hpp"
#include "taut/kernels/implicit_trial.hpp"
#include "taut/kernels/implicit_update.hpp"
#include "taut/kernels/vbd_mark.hpp"
#include "taut/plan/colliders.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/kernels/shared/line_search.h"
#include "taut/kernels/shared/solid_state.h"

#include <algorithm>
#include <iterator>

namespace taut {
namespace {


void record_force(PlanBuilder& b, const ImplicitEuler& m)
{
    const std::uint32_t n = b.plan.vertex_count;
    kernels::implicit_force::Bindings<Use> uses = {.position = {b.plan.position},
                                                   .delta = {b.plan.delta},
                                                   .predicted = {b.plan.predicted},
                                                   .spring = {m.springs},
                                                   .table = {m.spring_table, 2},
                                                   .step_values = {b.plan.step_values, 0},
                                                   .b = {m.solve->b(), 3}};
    if (m.damped)
        uses.low = {b.plan.low};
    b.dispatch(kImplicitEuler, m.damped ? "damped" : "", uses, {n, m.scale, m.lift}, n);
}

void record_matrix(PlanBuilder& b, const ImplicitEuler& m, const Moment& moment)
{
    const std::uint32_t n = b.plan.vertex_count;
    const std::uint32_t report = moment.last ? 1 : 0;
    const kernels::implicit_matrix::Bindings<Use> springs = {.position = {b.plan.position},
                                                             .delta = {b.plan.delta},
                                                             .spring = {m.springs},
                                                             .table = {m.spring_table, 2},
                                                             .step_values = {b.plan.step_values, 0},
                                                             .values = {m.values, 9},
                                                             .events = {b.plan.events, 0}};
    b.dispatch(kImplicitEuler, "", springs, {n, report, m.scale}, n);
    for (const ImplicitKind& kind : m.kinds)
    {
        const kernels::implicit_euler_hinge::Bindings<Use> uses = {.position = {b.plan.position},
                                                                   .delta = {b.plan.delta},
                                                                   .constraint = {kind.records},
                                                                   .table = {kind.table, 2},
                                                                   .step_values = {b.plan.step_values, 0},
                                                                   .b = {m.solve->b(), 3},
                                                                   .values = {m.values, 9},
                                                                   .events = {b.plan.events, 0}};
        b.dispatch_by_name(kind.effect, "implicit_euler_" + kind.stem, "", uses,
                           {n, report, m.scale, m.lift}, n);
    }
    if (m.solid_count == 0)
        return;
    const kernels::implicit_solids::Bindings<Use> state = {.position = {b.plan.position, 4},
                                                           .delta = {b.plan.delta, 4},
                                                           .solid = {m.solids},
                                                           .step_values = {b.plan.step_values, 0},
                                                           .state = {m.solid_state, TAUT_SOLID_STATE},
                                                           .events = {b.plan.events, 0}};
    b.dispatch(kImplicitEuler, "", state, {m.solid_count, report, m.scale}, m.solid_count);
    const kernels::implicit_solid_blocks::Bindings<Use> blocks = {
        .solid = {m.solids, 4},
        .state = {m.solid_state, 4 * TAUT_SOLID_STATE},
        .table = {m.solid_table, 2},
        .b = {m.solve->b(), 3},
        .values = {m.values, 9}};
    b.dispatch(kImplicitEuler, "", blocks, {n, m.lift}, n);
}

/// The solver's start: the inertial guess, as far as it helps.
void record_guess(PlanBuilder& b, const ImplicitEuler& m)
{
    b.record(kImplicitEuler, [&](Recorder& recorder) {
        const linear::Gate always{m.solve->groups(), nullptr, 0};
        const linear::Grid rows = linear::make_grid(3 * b.plan.vertex_count, always.groups);
        const BufferPtr x = b.on_paper(m.solve->x());
        m.solve->system().record_product(recorder, always, x, m.product, m.curvatures);
        linear::launch(recorder, always, {"", b.plan.precision, kImplicitEuler},
                       kernels::dot::Bindings<Recorder::Binding>{
                           .x = x, .y = b.on_paper(m.solve->b()), .partials = m.products},
                       {rows.count, rows.chunk, always.groups});
        linear::launch(recorder, always, {"", b.plan.precision, kImplicitEuler},
                       kernels::implicit_guess::Bindings<Recorder::Binding>{
                           .products = m.products, .curvatures = m.curvatures, .x = x},
                       {rows.count, rows.chunk, always.groups});
    });
}

/// What nothing holds gets the momentum that it must have.
void record_momentum(PlanBuilder& b, const ImplicitEuler& m)
{
    if (m.part_count == 0)
        return;
    kernels::implicit_momentum::Bindings<Use> uses = {.start = {m.part_start},
                                                      .member = {m.part_members},
                                                      .position = {b.plan.position},
                                                      .delta = {b.plan.delta},
                                                      .predicted = {b.plan.predicted},
                                                      .x = {m.solve->x(), 3}};
    const bool contact = m.before != kNoBuffer;
    if (contact)
        uses.marks = {m.marks, 3};
    b.dispatch(kImplicitEuler, contact ? "contact" : "", uses, {m.part_count, m.lift}, m.part_count,
               b.plan.vertex_count);
}

/// Who stays where it is in this Newton step.
void record_hold(PlanBuilder& b, const ImplicitEuler& m, bool first)
{
    if (m.before == kNoBuffer)
        return;
    const std::uint32_t n = b.plan.vertex_count;
    const kernels::implicit_hold::Bindings<Use> uses = {.held = {m.held, 3},
                                                        .light = {m.light},
                                                        .before = {m.before},
                                                        .delta = {b.plan.delta},
                                                        .marks = {m.marks, 3}};
    b.dispatch(kImplicitEuler, "", uses, {n, first ? 1u : 0u}, n);
}

/// Colliders push between two Newton steps, so that the next one knows what they carry.
void record_push(PlanBuilder& b, const ImplicitEuler& m, const Moment& moment)
{
    if (m.before == kNoBuffer || moment.iteration + 1 == b.plan.iterations)
        return;
    const std::uint32_t n = b.plan.vertex_count;
    const kernels::vbd_mark::Bindings<Use> uses = {.delta = {b.plan.delta}, .solved = {m.before}};
    b.dispatch(kImplicitEuler, "", uses, {n}, n);
    record_colliders(b, moment, {.first = true}); // friction knows of one push at a time
}

/// Where passes of trials begin and the last ends: a step that is taken whole pays for one trial, one that is
/// taken by a quarter for three.
constexpr std::uint32_t kPasses[] = {0, 1, 3, TAUT_TRIALS};

/// Trials first..end-1 of the line search: the whole step, its half, its quarter, ...
struct Pass
{
    std::uint32_t first, end;
};

/// The part of elements of one kind.
void record_rise(PlanBuilder& b, const ImplicitEuler& m, Recorder& recorder, const ImplicitKind& kind,
                 std::uint32_t part, const Pass& pass)
{
    const linear::Gate always{m.solve->groups(), nullptr, 0};
    const linear::Grid grid = linear::make_grid(kind.count, always.groups);
    const std::string kernel = "implicit_euler_rise_" + kind.stem;
    linear::launch(recorder, always, {"", b.plan.precision, kind.effect, kernel},
                   kernels::implicit_euler_rise_hinge::Bindings<Recorder::Binding>{
                       .position = b.on_paper(b.plan.position),
                       .delta = b.on_paper(b.plan.delta),
                       .x = b.on_paper(m.solve->x()),
                       .partials = m.trials,
                       .constraint = b.on_paper(kind.records),
                       .step_values = b.on_paper(b.plan.step_values)},
                   {grid.count, grid.chunk, always.groups, pass.first, pass.end, part, m.parts(), m.scale,
                    m.lift});
}

void record_trials(PlanBuilder& b, const ImplicitEuler& m, Recorder& recorder, const Pass& pass)
{
    const linear::Gate always{m.solve->groups(), nullptr, 0};
    std::uint32_t part = 0;
    using Bindings = kernels::implicit_trial::Bindings<Recorder::Binding>;
    const auto add = [&](std::string_view variant, std::uint32_t count, Bindings bindings) {
        const linear::Grid grid = linear::make_grid(count, always.groups);
        bindings.position = b.on_paper(b.plan.position);
        bindings.delta = b.on_paper(b.plan.delta);
        bindings.x = b.on_paper(m.solve->x());
        bindings.partials = m.trials;
        linear::launch(recorder, always, {variant, b.plan.precision, kImplicitEuler}, bindings,
                       {grid.count, grid.chunk, always.groups, pass.first, pass.end, part++, m.parts(),
                        m.scale, m.lift});
    };
    const BufferPtr step_values = b.on_paper(b.plan.step_values);
    add("", b.plan.vertex_count, {.predicted = b.on_paper(b.plan.predicted)});
    if (m.spring_count > 0)
        add("springs", m.spring_count,
            {.spring = b.on_paper(m.springs), .step_values = step_values, .low = b.on_paper(b.plan.low)});
    for (const ImplicitKind& kind : m.kinds)
        record_rise(b, m, recorder, kind, part++, pass);
    if (m.solid_count > 0)
        add("solids", m.solid_count, {.step_values = step_values, .solid = b.on_paper(m.solids)});
}

void record_search(PlanBuilder& b, const ImplicitEuler& m)
{
    for (std::size_t k = 0; k + 1 < std::size(kPasses) && kPasses[k] < m.trial_count; ++k)
        b.record(
            kImplicitEuler,
            [&](Recorder& recorder) {
                record_trials(b, m, recorder, {kPasses[k], std::min(kPasses[k + 1], m.trial_count)});
            },
            k > 0);
}

void record_update(PlanBuilder& b, const ImplicitEuler& m)
{
    if (m.trials)
        record_search(b, m);
    b.record(kImplicitEuler, [&](Recorder& recorder) {
        const linear::Gate always{m.solve->groups(), nullptr, 0};
        const linear::Grid grid = linear::make_grid(b.plan.vertex_count, always.groups);
        linear::launch(
            recorder, always, {m.trials ? "search" : "", b.plan.precision, kImplicitEuler},
            kernels::implicit_update::Bindings<Recorder::Binding>{
                .delta = b.on_paper(b.plan.delta), .x = b.on_paper(m.solve->x()), .partials = m.trials},
            {grid.count, grid.chunk, always.groups, m.trial_count, m.parts(), m.lift});
    });
}

} // namespace

void record_implicit_start(PlanBuilder& b, const Moment&)
{
    if (!b.implicit_euler)
        return;
    const ImplicitEuler& m = *b.implicit_euler;
    const std::uint32_t n = b.plan.vertex_count;
    const kernels::implicit_start::Bindings<Use> uses = {.low = {b.plan.low},
                                                         .held = {m.held, 3},
                                                         .predicted = {b.plan.predicted},
                                                         .delta = {b.plan.delta},
                                                         .guess = {m.solve->x(), 3}};
    b.dispatch(kImplicitEuler, "", uses, {n, m.lift}, n);
}

void record_implicit_step(PlanBuilder& b, const Moment& moment)
{
    if (!b.implicit_euler)
        return;
    ImplicitEuler& m = *b.implicit_euler;
    record_hold(b, m, moment.iteration == 0);
    record_force(b, m);
    record_matrix(b, m, moment);
    if (moment.iteration == 0)
        record_guess(b, m);
    if (m.coarse && moment.substep == 0 && moment.iteration == 0) // once a step: it may lag behind the matrix
        b.record(kImplicitEuler, [&](Recorder& recorder) {
            m.coarse->form(recorder, {m.solve->groups(), nullptr, 0});
        });
    m.solve->record(b);
    record_momentum(b, m);
    record_update(b, m);
    record_push(b, m, moment);
}

} // namespace taut
