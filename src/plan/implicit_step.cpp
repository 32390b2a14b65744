// The passes of a substep of implicit Euler.
//
// Based on, Departures: implicit_euler.cpp.

#include "taut/plan/implicit_euler.hpp"

#include "taut/plan/implicit_system.hpp"

#include "taut/kernels/dot.hpp"
#include "taut/kernels/implicit_force.hpp"
#include "taut/kernels/implicit_guess.hpp"
#include "taut/kernels/implicit_hinges.hpp"
#include "taut/kernels/implicit_hold.hpp"
#include "taut/kernels/implicit_matrix.hpp"
#include "taut/kernels/implicit_momentum.hpp"
#include "taut/kernels/implicit_solid_blocks.hpp"
#include "taut/kernels/implicit_solids.hpp"
#include "taut/kernels/implicit_start.hpp"
#include "taut/kernels/implicit_trial.hpp"
#include "taut/kernels/implicit_update.hpp"
#include "taut/kernels/vbd_mark.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/kernels/shared/solid_state.h"

namespace taut {
namespace {

constexpr std::string_view kName = "implicit_euler";

void record_force(PlanBuilder& b, const ImplicitEuler& m)
{
    const std::uint32_t n = b.plan.vertex_count;
    std::vector<Use> uses = {{b.plan.position},   {b.plan.delta},          {b.plan.predicted}, {m.springs},
                             {m.spring_table, 2}, {b.plan.step_values, 0}, {m.solve->b(), 3}};
    if (m.damped)
        uses.push_back({b.plan.low});
    b.dispatch(kName, "implicit_force", m.damped ? "damped" : "", uses,
               kernels::implicit_force::Params{n, m.scale, m.lift}, n);
}

void record_matrix(PlanBuilder& b, const ImplicitEuler& m, const Moment& moment)
{
    const std::uint32_t n = b.plan.vertex_count;
    const std::uint32_t report = moment.last ? 1 : 0;
    const Use springs[] = {{b.plan.position},       {b.plan.delta}, {m.springs},       {m.spring_table, 2},
                           {b.plan.step_values, 0}, {m.values, 9},  {b.plan.events, 0}};
    b.dispatch(kName, "implicit_matrix", "", springs, kernels::implicit_matrix::Params{n, report, m.scale},
               n);
    if (m.hinge_count > 0)
    {
        const Use hinges[] = {{b.plan.position},       {b.plan.delta},    {m.hinges},    {m.hinge_table, 2},
                              {b.plan.step_values, 0}, {m.solve->b(), 3}, {m.values, 9}, {b.plan.events, 0}};
        b.dispatch(kName, "implicit_hinges", "", hinges,
                   kernels::implicit_hinges::Params{n, report, m.scale, m.lift}, n);
    }
    if (m.solid_count == 0)
        return;
    const Use state[] = {{b.plan.position, 4}, {b.plan.delta, 4},
                         {m.solids},           {b.plan.step_values, 0},
                         {m.solid_state, TAUT_SOLID_STATE},
                         {b.plan.events, 0}};
    b.dispatch(kName, "implicit_solids", "", state,
               kernels::implicit_solids::Params{m.solid_count, report, m.scale}, m.solid_count);
    const Use blocks[] = {{m.solids, 4}, {m.solid_state, 4 * TAUT_SOLID_STATE},
                          {m.solid_table, 2}, {m.solve->b(), 3}, {m.values, 9}};
    b.dispatch(kName, "implicit_solid_blocks", "", blocks,
               kernels::implicit_solid_blocks::Params{n, m.lift}, n);
}

/// The solver's start: the inertial guess, as far as it helps.
void record_guess(PlanBuilder& b, const ImplicitEuler& m)
{
    b.record(kName, [&](Recorder& recorder) {
        const linear::Gate always{m.solve->groups(), nullptr, 0};
        const linear::Grid rows = linear::make_grid(3 * b.plan.vertex_count, always.groups);
        const BufferPtr x = b.on_paper(m.solve->x());
        m.solve->system().record_product(recorder, always, x, m.product, m.curvatures);
        linear::launch(recorder, always, kernels::dot::info("", b.plan.precision),
                       {x, b.on_paper(m.solve->b()), m.products},
                       kernels::dot::Params{rows.count, rows.chunk, always.groups}, kName);
        linear::launch(recorder, always, kernels::implicit_guess::info("", b.plan.precision),
                       {m.products, m.curvatures, x},
                       kernels::implicit_guess::Params{rows.count, rows.chunk, always.groups}, kName);
    });
}

/// What nothing holds gets the momentum that it must have.
void record_momentum(PlanBuilder& b, const ImplicitEuler& m)
{
    if (m.part_count == 0)
        return;
    std::vector<Use> uses = {{m.part_start}, {m.part_members},   {b.plan.position},
                             {b.plan.delta}, {b.plan.predicted}, {m.solve->x(), 3}};
    const bool contact = m.before != kNoBuffer;
    if (contact)
        uses.push_back({m.marks, 3});
    b.dispatch(kName, "implicit_momentum", contact ? "contact" : "", uses,
               kernels::implicit_momentum::Params{m.part_count, m.lift}, m.part_count, b.plan.vertex_count);
}

/// Who stays where it is in this Newton step.
void record_hold(PlanBuilder& b, const ImplicitEuler& m, bool first)
{
    if (m.before == kNoBuffer)
        return;
    const std::uint32_t n = b.plan.vertex_count;
    const Use uses[] = {{m.held, 3}, {m.light}, {m.before}, {b.plan.delta}, {m.marks, 3}};
    b.dispatch(kName, "implicit_hold", "", uses, kernels::implicit_hold::Params{n, first ? 1u : 0u}, n);
}

/// Colliders push between two Newton steps, so that the next one knows what they carry.
void record_push(PlanBuilder& b, const ImplicitEuler& m, Moment moment)
{
    if (m.before == kNoBuffer || moment.iteration + 1 == b.plan.iterations)
        return;
    const std::uint32_t n = b.plan.vertex_count;
    const Use uses[] = {{b.plan.delta}, {m.before}};
    b.dispatch(kName, "vbd_mark", "", uses, kernels::vbd_mark::Params{n}, n);
    moment.iteration = 0; // friction knows of one push at a time
    moment.last = false;
    record_colliders(b, moment);
}

void record_trials(PlanBuilder& b, const ImplicitEuler& m, Recorder& recorder)
{
    const linear::Gate always{m.solve->groups(), nullptr, 0};
    const std::uint32_t trials = b.scene.method.line_search + 1;
    std::uint32_t part = 0;
    const auto add = [&](std::string_view variant, std::uint32_t count, std::vector<Recorder::Binding> more) {
        const linear::Grid grid = linear::make_grid(count, always.groups);
        std::vector<Recorder::Binding> bindings = {b.on_paper(b.plan.position), b.on_paper(b.plan.delta),
                                                   b.on_paper(m.solve->x()), m.trials};
        bindings.insert(bindings.end(), more.begin(), more.end());
        linear::launch(recorder, always, kernels::implicit_trial::info(variant, b.plan.precision),
                       std::move(bindings),
                       kernels::implicit_trial::Params{grid.count, grid.chunk, always.groups, trials, part++,
                                                       m.parts(), m.scale, m.lift},
                       kName);
    };
    const BufferPtr step_values = b.on_paper(b.plan.step_values);
    add("", b.plan.vertex_count, {b.on_paper(b.plan.predicted)});
    if (m.spring_count > 0)
        add("springs", m.spring_count, {b.on_paper(m.springs), step_values, b.on_paper(b.plan.low)});
    if (m.hinge_count > 0)
        add("hinges", m.hinge_count, {b.on_paper(m.hinges), step_values});
    if (m.solid_count > 0)
        add("solids", m.solid_count, {b.on_paper(m.solids), step_values});
}

void record_update(PlanBuilder& b, const ImplicitEuler& m)
{
    b.record(kName, [&](Recorder& recorder) {
        const linear::Gate always{m.solve->groups(), nullptr, 0};
        const linear::Grid grid = linear::make_grid(b.plan.vertex_count, always.groups);
        std::vector<Recorder::Binding> bindings = {b.on_paper(b.plan.delta), b.on_paper(m.solve->x())};
        if (m.trials)
        {
            record_trials(b, m, recorder);
            bindings.push_back(m.trials);
        }
        linear::launch(recorder, always,
                       kernels::implicit_update::info(m.trials ? "search" : "", b.plan.precision),
                       std::move(bindings),
                       kernels::implicit_update::Params{grid.count, grid.chunk, always.groups,
                                                        b.scene.method.line_search + 1, m.parts(), m.lift},
                       kName);
    });
}

} // namespace

void record_implicit_start(PlanBuilder& b, const Moment&)
{
    if (!b.implicit_euler)
        return;
    const ImplicitEuler& m = *b.implicit_euler;
    const std::uint32_t n = b.plan.vertex_count;
    const Use uses[] = {{b.plan.low}, {m.held, 3}, {b.plan.predicted}, {b.plan.delta}, {m.solve->x(), 3}};
    b.dispatch(kName, "implicit_start", "", uses, kernels::implicit_start::Params{n, m.lift}, n);
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
    m.solve->record(b);
    record_momentum(b, m);
    record_update(b, m);
    record_push(b, m, moment);
}

} // namespace taut
