// ACAD: springs beyond a strain become implicit constraints, and go back when they need not be.
//
// Based on:
//   Va, Choi, Hong. Real-Time Cloth Simulation Using Compute Shader in Unity3D for AR/VR Contents. Applied
//   Sciences 11(17), 2021, and the same authors 2022 (adaptive constraint activation and deactivation).
// Departures: the rule that a spring goes back when its multiplier, the mean of two substeps, is less than
//   the spring's own force, and the target L (1 + strain), which injects no speed, are ours to choose
//   (docs/methods/acad.md); compressed springs stay springs unless the scene asks (`compress`); rows far
//   beyond their length are softened.

#include "taut/plan/acad.hpp"

#include "taut/kernels/acad_begin.hpp"
#include "taut/kernels/acad_flag.hpp"
#include "taut/kernels/acad_force.hpp"
#include "taut/kernels/acad_rows.hpp"
#include "taut/kernels/acad_scan.hpp"
#include "taut/kernels/acad_scatter.hpp"
#include "taut/kernels/acad_store.hpp"
#include "taut/kernels/acad_touch.hpp"
#include "taut/kernels/constraint_rows.hpp"
#include "taut/kernels/constraint_spread.hpp"
#include "taut/kernels/shared/active_rows.h"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

namespace taut {
namespace {

constexpr const char* kAcadEffect = "acad";
constexpr std::uint64_t kWord = 4;

/// A strain as a sum of two floats, for parameters.
struct Strain
{
    explicit Strain(double value)
        : high(static_cast<float>(value)),
          low(static_cast<float>(value - static_cast<double>(high)))
    {}
    float high, low;
};

/// Strain below which a row is released; -1 where multipliers decide.
double release_strain(const Scene& scene)
{
    return scene.method.release == ReleaseRule::strain ? scene.method.release_strain : -1;
}

double target_length(const Scene& scene, const StretchElement& e)
{
    return scene.method.target == ConstraintTarget::rest ? e.rest_length
                                                         : e.rest_length * (1 + scene.method.activate_strain);
}

std::uint32_t size_of(const Acad& a) { return static_cast<std::uint32_t>(a.elements.size()); }
std::uint32_t vertex_chunk(const PlanBuilder& b, const Acad& a)
{
    return linear::make_grid(b.plan.vertex_count, a.groups).chunk;
}
/// Of the list of vertices with rows: there are twice as many at most as rows.
std::uint32_t listed_chunk(const Acad& a) { return 2 * a.chunk; }

/// Two records a spring: the constraint that it may become, and the spring itself with what acad_rows asks.
template <typename Real>
void add_candidates(PlanBuilder& b, Acad& a, const std::vector<StretchElement>& targets,
                    const std::vector<layout::Spring<Real>>& springs)
{
    std::vector<layout::Spring<Real>> candidates;
    const std::vector<double> compliances = row_compliances(b, a.elements);
    const auto springs_at = [&](std::uint32_t v) {
        return b.inverse_mass[v] > 0 ? a.at.start[v + 1] - a.at.start[v] : 1u;
    };
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
        const StretchElement& e = a.elements[k];
        candidates.push_back(spring_record<Real>(targets[k]));
        candidates.back().stiffness = row_stiffness<Real>(compliances[k]);
        candidates.push_back(springs[k]);
        candidates.back().damping = static_cast<Real>(inverse_diagonal(b, e, compliances[k]));
        candidates.back().kind = std::max(springs_at(e.a), springs_at(e.b));
    }
    a.candidates = b.add_buffer<layout::Spring<Real>>(kAcadEffect, "rows", candidates);
}

template <typename Real>
void add_spring_records(PlanBuilder& b, Acad& a)
{
    using Record = layout::Spring<Real>;
    std::vector<Record> springs = records_of(a.elements, spring_record<Real>), ends;
    std::vector<Real> hold;
    std::vector<StretchElement> targets = a.elements;
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
        const StretchElement& e = a.elements[k];
        springs[k].kind = may_be_constrained(b.scene, e);
        targets[k].rest_length = target_length(b.scene, e);
        hold.push_back(static_cast<Real>((targets[k].rest_length - e.rest_length) / e.compliance));
    }
    for (const std::uint32_t entry : a.at.entries)
    {
        ends.push_back(springs[entry / 2]);
        ends.back().kind = entry / 2 * 2 + springs[entry / 2].kind;
        if (entry % 2 == 1)
            std::swap(ends.back().a, ends.back().b);
    }
    a.springs = b.add_buffer<Record>(kAcadEffect, "springs", springs);
    a.ends = b.add_buffer<Record>(kAcadEffect, "spring ends", ends);
    add_candidates(b, a, targets, springs);
    a.hold = b.add_buffer<Real>(kAcadEffect, "forces at the threshold", hold);
    a.rows.records = b.add_buffer(kAcadEffect, "active rows", springs.size() * sizeof(Record));
}

void add_choice_buffers(PlanBuilder& b, Acad& a)
{
    const std::uint64_t springs = size_of(a), vertices = b.plan.vertex_count;
    const std::uint64_t real = b.real_size();
    a.rows.start = b.add_buffer<std::uint32_t>(kAcadEffect, "springs at a vertex, start", a.at.start);
    a.rows.incident = b.add_buffer<std::uint32_t>(kAcadEffect, "springs at a vertex", a.at.entries);
    a.rows.direction = b.add_buffer(kAcadEffect, "row directions", springs * 4 * real);
    a.rows.spread = b.add_buffer(kAcadEffect, "moves of vertices", vertices * 4 * real);
    a.rows.list = b.add_buffer(kAcadEffect, "vertices of rows", (vertices + 1) * kWord);
    a.rows.place = b.add_buffer(kAcadEffect, "rows of springs", springs * kWord);
    a.row_list = b.add_buffer(kAcadEffect, "springs of rows", (springs + 1) * kWord);
    a.flags = b.add_buffer(kAcadEffect, "flags", (springs + 1) * kWord);
    a.multiplier = b.add_buffer(kAcadEffect, "multipliers", springs * real);
    a.touched = b.add_buffer(kAcadEffect, "ends of constraints", vertices * kWord);
    a.sums = b.add_buffer(kAcadEffect, "sums of groups", 2 * std::uint64_t(a.groups) * kWord);
    std::vector<std::uint32_t> control(TAUT_ACAD_WORDS, 0);
    for (const std::size_t word : {TAUT_ACAD_CHOOSE, TAUT_ACAD_SCAN, TAUT_ACAD_SOLVE, TAUT_ACAD_ONCE})
        control[word + 1] = control[word + 2] = 1;
    a.control = b.add_buffer<std::uint32_t>(kAcadEffect, "acad control", control);
    if (b.plan.iterations > 1)
        a.total = b.add_buffer(kAcadEffect, "multipliers of the substep", springs * real);
    PlanBuffer& events = b.plan.buffers[b.plan.events]; // with room for the count of this method
    events.bytes = TAUT_EVENT_WORDS * kWord;
}

/// Adds a pass under the gate of three words of the control buffer.
template <template <typename> typename Bindings>
void gated(PlanBuilder& b, const Acad& a, std::string_view variant, const Bindings<Use>& uses,
           const typename Bindings<Use>::Params& params, std::uint32_t groups, std::uint32_t gate)
{
    b.dispatch_indirect(kAcadEffect, variant, uses, params, groups, a.control, gate * kWord);
}

void record_choice(PlanBuilder& b, Acad& a)
{
    const std::uint32_t springs = size_of(a), n = b.plan.vertex_count;
    const Strain on(b.scene.method.activate_strain), off(release_strain(b.scene));
    const kernels::acad_begin::Bindings<Use> begin = {
        .events = {b.plan.events, 0}, .control = {a.control, 0}, .flags = {a.flags}};
    b.dispatch(kAcadEffect, "", begin, {1, a.groups, springs}, 1);
    const kernels::acad_flag::Bindings<Use> flag = {.spring = {a.springs},
                                                    .position = {b.plan.position, 2},
                                                    .low = {b.plan.low, 2},
                                                    .flags = {a.flags},
                                                    .multiplier = {a.multiplier},
                                                    .sums = {a.sums}};
    gated(b, a, "", flag,
          {springs, a.chunk, a.groups, on.high, on.low, off.high, off.low, b.scene.method.compress}, a.groups,
          TAUT_ACAD_CHOOSE);
    const kernels::acad_touch::Bindings<Use> touch = {.start = {a.rows.start},
                                                      .incident = {a.rows.incident},
                                                      .flags = {a.flags},
                                                      .touched = {a.touched},
                                                      .sums = {a.sums}};
    gated(b, a, "", touch, {n, vertex_chunk(b, a), a.groups}, a.groups, TAUT_ACAD_CHOOSE);
    const kernels::acad_scan::Bindings<Use> scan = {.sums = {a.sums},
                                                    .control = {a.control},
                                                    .solver_control = {a.solve->control(b)},
                                                    .row_list = {a.row_list},
                                                    .list = {a.rows.list},
                                                    .row = {a.rows.records},
                                                    .partials = {a.solve->partials(b)},
                                                    .curvatures = {a.solve->curvatures(b)}};
    gated(b, a, "", scan, {springs, a.chunk, a.groups}, 1, TAUT_ACAD_SCAN);
    const kernels::acad_scatter::Bindings<Use> rows = {
        .flags = {a.flags}, .sums = {a.sums}, .list = {a.row_list}, .place = {a.rows.place}};
    gated(b, a, "place", rows, {springs, a.chunk, 0, a.groups}, a.groups, TAUT_ACAD_CHOOSE);
    const kernels::acad_scatter::Bindings<Use> vertices = {
        .flags = {a.touched}, .sums = {a.sums}, .list = {a.rows.list}};
    gated(b, a, "", vertices, {n, vertex_chunk(b, a), a.groups, a.groups}, a.groups, TAUT_ACAD_CHOOSE);
}

} // namespace

void check_acad(const Scene& scene, Refusals& out)
{
    refuse_rigid(scene, out);
    check_constrained_lengths(scene, out);
    check_semi_implicit(scene, out);
}

void prepare_acad(PlanBuilder& b)
{
    auto a = std::make_shared<Acad>();
    a->elements = all_springs(b);
    a->damped = std::any_of(a->elements.begin(), a->elements.end(),
                            [](const StretchElement& e) { return e.damping > 0; });
    if (a->elements.empty())
        return;
    a->at = incidence_of(b.plan.vertex_count, a->elements);
    a->rows.count = size_of(*a);
    a->groups = linear::group_count_for(a->rows.count, b.paper()->info());
    a->chunk = linear::make_grid(a->rows.count, a->groups).chunk;
    check_row_trips(b, a->at, std::max(vertex_chunk(b, *a), listed_chunk(*a)));
    with_real(b.plan.precision, [&](auto zero) { add_spring_records<decltype(zero)>(b, *a); });
    add_choice_buffers(b, *a);
    const BufferPtr inverse =
        b.paper()->make_buffer(a->rows.count * b.real_size(), "inverses of rows", BufferUse::device);
    a->solve.emplace(b, kAcadEffect, std::make_shared<ConstraintOperator>(b, a->rows),
                     linear::Preconditioning{linear::Preconditioner::jacobi, inverse, nullptr});
    a->solve->use_part(b, a->control, TAUT_ACAD_SOLVE * kWord, TAUT_ACAD_ONCE * kWord);
    b.plan.kept.insert(b.plan.kept.end(), {a->flags, a->multiplier});
    b.plan.active = {a->control, TAUT_ACAD_ROWS * kWord,
                     static_cast<std::uint32_t>(
                         std::count_if(a->elements.begin(), a->elements.end(), [&](const StretchElement& e) {
                             return may_be_constrained(b.scene, e);
                         }))};
    add_inner_forces(b, kAcadEffect, a->rows.count);
    b.acad = std::move(a);
}

void record_acad_forces(PlanBuilder& b, const Moment& moment)
{
    if (!b.acad)
        return;
    Acad& a = *b.acad;
    const std::uint32_t n = b.plan.vertex_count, each = 2 * size_of(a) / n + 1;
    const Strain on(b.scene.method.activate_strain), off(release_strain(b.scene));
    kernels::acad_force::Bindings<Use> uses = {.start = {a.rows.start},
                                               .end = {a.ends, each},
                                               .position = {b.plan.position, 1 + each},
                                               .low = {b.plan.low, 1 + each},
                                               .force = {b.forces->force},
                                               .events = {b.plan.events, 0},
                                               .flags = {a.flags, each}};
    if (a.damped)
        uses.velocity = {b.plan.velocity, 1 + each};
    b.dispatch(kAcadEffect, a.damped ? "damped" : "", uses,
               {n, moment.substep + 1 == b.plan.substeps, size_of(a), on.high, on.low, off.high, off.low,
                b.scene.method.compress},
               n);
    record_choice(b, a);
}

void record_acad_solve(PlanBuilder& b, const Moment& moment)
{
    if (!b.acad)
        return;
    Acad& a = *b.acad;
    const std::uint32_t springs = size_of(a), further = moment.iteration > 0;
    const bool last = moment.iteration + 1 == b.plan.iterations, kept = a.total != kNoBuffer;
    const kernels::acad_rows::Bindings<Use> copy = {.row_list = {a.row_list},
                                                    .candidate = {a.candidates, 2},
                                                    .multiplier = {a.multiplier},
                                                    .row = {a.rows.records},
                                                    .x = {a.solve->x()},
                                                    .inverse = {a.solve->inverse()},
                                                    .position = {b.plan.position, 2},
                                                    .step_values = {b.plan.step_values, 0}};
    gated(b, a, "", copy, {springs, a.chunk, further}, a.groups, TAUT_ACAD_SOLVE);
    kernels::constraint_rows::Bindings<Use> uses = {.row = {a.rows.records},
                                                    .position = {b.plan.position, 2},
                                                    .delta = {b.plan.delta, 2},
                                                    .step_values = {b.plan.step_values, 0},
                                                    .events = {b.plan.events, 0},
                                                    .direction = {a.rows.direction},
                                                    .b = {a.solve->b()}};
    if (kept)
        uses.multiplier = {a.total};
    gated(b, a, kept ? "kept" : "", uses, {springs, a.chunk, further, moment.last, 0}, a.groups,
          TAUT_ACAD_SOLVE);
    a.solve->record(b);
    kernels::acad_store::Bindings<Use> store = {.row_list = {a.row_list},
                                                .x = {a.solve->x()},
                                                .multiplier = {a.multiplier},
                                                .flags = {a.flags},
                                                .hold = {a.hold},
                                                .state = {a.solve->state(), 0},
                                                .step_values = {b.plan.step_values, 0}};
    if (kept)
        store.total = {a.total};
    const std::uint32_t release = b.scene.method.release == ReleaseRule::multiplier;
    gated(b, a, kept ? "total" : "", store, {springs, a.chunk, further, last, release}, a.groups,
          TAUT_ACAD_SOLVE);
    const kernels::constraint_spread::Bindings<Use> moved = {.start = {a.rows.start},
                                                             .incident = {a.rows.incident},
                                                             .direction = {a.rows.direction},
                                                             .x = {a.solve->x()},
                                                             .position = {b.plan.position},
                                                             .delta = {b.plan.delta},
                                                             .list = {a.rows.list},
                                                             .place = {a.rows.place}};
    gated(b, a, "listed_apply", moved, {b.plan.vertex_count, listed_chunk(a)}, a.groups, TAUT_ACAD_SOLVE);
}

} // namespace taut
