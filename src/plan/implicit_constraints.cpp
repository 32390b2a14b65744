// Springs as implicit constraints: one linear system a substep, or more, each at the places that the one
// before led to.
//
// Based on:
//   Hong, Choi, Jung, Welch, Trapp. Effective Constrained Dynamic Simulation Using Implicit Constraint
//   Enforcement. ICRA 2005: C + J dx = 0 at the end of the step, (J W J^T) lambda = C / h^2 + ...
//   Goldenthal, Harmon, Fattal, Bercovier, Grinspun. Efficient Simulation of Inextensible Cloth. SIGGRAPH
//   2007: the further solves (fast projection).
//   Va, Choi, Hong. Real-time Volume Preserving Constraints for Volumetric Model on GPU. CMC 73(1), 2022: a
//   row a tetrahedron beside those of its edges.
// Departures: it corrects the displacement that the frame of a substep has guessed, which is the same
//   (L = h^2 lambda); compliance and damper of a spring stay on the diagonal; the first solve starts from the
//   multipliers of the last substep.

#include "taut/plan/implicit_constraints.hpp"

#include "taut/kernels/constraint_rows.hpp"
#include "taut/kernels/constraint_spread.hpp"
#include "taut/kernels/constraint_total.hpp"
#include "taut/kernels/corner_spread.hpp"
#include "taut/plan/methods.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/redundant_rows.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/stability.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

constexpr const char* kImplicitConstraintsEffect = "implicit_constraints";

std::uint32_t groups_of(const PlanBuilder& b, const ImplicitConstraints& c)
{
    return linear::group_count_for(c.rows.all(), b.paper()->info());
}

/// Rigid springs of different lengths between the same vertices cannot all be held.
void warn_of_contradictions(PlanBuilder& b, const ImplicitConstraints& c)
{
    const double h = b.plan.timestep / b.plan.substeps;
    const RedundantRows parts = redundant_rows(c.elements, b.inverse_mass);
    std::size_t count = 0;
    for (std::size_t k = 0; k < c.elements.size(); ++k)
    {
        const double w = b.inverse_mass[c.elements[k].a] + b.inverse_mass[c.elements[k].b];
        count += parts.contradictory[k] && c.compliances[k] <= kContradiction * h * h * w;
    }
    if (count > 0)
        b.plan.warnings.push_back({"conflict", count,
                                   std::to_string(count) + " springs without compliance join two vertices "
                                                           "that another of another length joins too"});
}

void add_row_buffers(PlanBuilder& b, ImplicitConstraints& c)
{
    c.at = incidence_of(b.plan.vertex_count, c.elements);
    c.rows.count = static_cast<std::uint32_t>(c.elements.size());
    c.corners = corner_set(b);
    c.rows.corners.count = static_cast<std::uint32_t>(c.corners.size()); // groups are of all rows
    c.rows.corners = add_corner_buffers(b, kImplicitConstraintsEffect, c.corners, groups_of(b, c));
    check_row_trips(b, c.at, linear::make_grid(b.plan.vertex_count, groups_of(b, c)).chunk);
    const std::uint64_t vec = 4 * b.real_size();
    c.compliances = row_compliances(b, c.elements);
    warn_of_contradictions(b, c);
    c.rows.records = add_row_records(b, kImplicitConstraintsEffect, c.elements, c.compliances);
    c.rows.start =
        b.add_buffer<std::uint32_t>(kImplicitConstraintsEffect, "rows at a vertex, start", c.at.start);
    c.rows.incident =
        b.add_buffer<std::uint32_t>(kImplicitConstraintsEffect, "rows at a vertex", c.at.entries);
    c.rows.direction = b.add_buffer(kImplicitConstraintsEffect, "row directions", c.rows.count * vec);
    if (b.plan.iterations > 1)
        c.multiplier = b.add_buffer(kImplicitConstraintsEffect, "multipliers of the substep",
                                    c.rows.all() * b.real_size());
}

void make_matrix(PlanBuilder& b, ImplicitConstraints& c)
{
    const std::vector<std::uint32_t> corners = c.corners.corners();
    if (corners.empty())
        c.matrix.emplace(b, kImplicitConstraintsEffect, constraint_pattern(c.elements, c.at, b.inverse_mass),
                         c.rows.direction);
    else
        c.matrix.emplace(b, kImplicitConstraintsEffect,
                         constraint_terms(c.elements, c.at, corners,
                                          incidence_of(b.plan.vertex_count, corners, 4), b.inverse_mass),
                         c.rows.direction, c.rows.corners.gradient);
}

BufferPtr diagonal_inverse(PlanBuilder& b, const ImplicitConstraints& c)
{
    return with_real(b.plan.precision, [&](auto zero) {
        std::vector<decltype(zero)> values;
        for (std::size_t k = 0; k < c.elements.size(); ++k)
            values.push_back(
                static_cast<decltype(zero)>(inverse_diagonal(b, c.elements[k], c.compliances[k])));
        for (const double value : c.corners.inverse)
            values.push_back(static_cast<decltype(zero)>(value));
        const BufferPtr buffer =
            b.paper()->make_buffer(values.size() * sizeof(zero), "constraint inverse", BufferUse::device);
        b.paper()->write(buffer, 0, std::as_bytes(std::span(values)));
        return buffer;
    });
}

} // namespace

bool may_be_constrained(const Scene& scene, const StretchElement& spring)
{
    return scene.method.constrained == ConstrainedSprings::all || spring.kind == SpringKind::structural;
}

void check_constrained_lengths(const Scene& scene, Refusals& out)
{
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        for (const StretchElement& e : stretch_elements(body))
            if (may_be_constrained(scene, e) && !(e.rest_length > 0))
                throw Error(
                    ErrorCode::degenerate_rest,
                    "bodies[" + std::to_string(k) + "] has a spring between the vertices " +
                        std::to_string(e.a) + " and " + std::to_string(e.b) +
                        " without length at rest, and as a constraint it has no direction there; give "
                        "it one, or take method.type \"xpbd\"");
    });
}

void check_semi_implicit(const Scene& scene, Refusals& out)
{
    // No pass of constraint enforcement would give back what the kick takes of gravity.
    out.attempt([&] {
        if (scene.method.integrator != Integrator::semi_implicit)
            throw Error(ErrorCode::unsupported, "method.integrator is " + quoted(scene.method.integrator) +
                                                    ", but method.type " + quoted(scene.method.type) +
                                                    " steps by \"semi_implicit\" only");
    });
}

void check_implicit_constraints(const Scene& scene, Refusals& out)
{
    check_constrained_lengths(scene, out);
    check_semi_implicit(scene, out);
    bool rows = false;
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        for (const StretchElement& e : stretch_elements(body))
        {
            rows = rows || may_be_constrained(scene, e);
            if (acts_as_force(scene, e) && !(e.compliance > 0))
                throw Error(ErrorCode::unsupported,
                            "bodies[" + std::to_string(k) + "] has a rigid spring between the vertices " +
                                std::to_string(e.a) + " and " + std::to_string(e.b) +
                                ", but method.constrained leaves it a spring; give it a finite "
                                "stiffness, or take method.constrained \"all\"");
        }
    });
    out.attempt_bodies(scene, [&](const Body& body, std::size_t k) {
        if (!rows && !bend_elements(body).empty())
            throw Error(ErrorCode::unsupported,
                        "bodies[" + std::to_string(k) +
                            "].material has bending_stiffness, but the scene no spring that is a constraint, "
                            "and hinges alone are not solved; give it a stretch_stiffness");
    });
}

std::vector<double> row_compliances(const PlanBuilder& b, std::span<const StretchElement> springs)
{
    const std::optional<double> given = b.scene.method.constraint_compliance;
    const double h = b.plan.timestep / b.plan.substeps;
    const bool rigid = b.scene.method.type == MethodKind::acad;
    const RedundantRows parts = redundant_rows(springs, b.inverse_mass);
    std::vector<double> out;
    std::size_t first = 0;
    for (std::size_t body = 0; body + 1 < b.plan.body_start.size(); ++body)
    {
        std::size_t free = 0, last = first;
        for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
            free += b.inverse_mass[v] > 0;
        // The same spring twice is twice the same equation, which conjugate gradients do not mind.
        std::set<std::pair<std::uint32_t, std::uint32_t>> different;
        for (; last < springs.size() && springs[last].a < b.plan.body_start[body + 1]; ++last)
            different.insert(std::minmax(springs[last].a, springs[last].b));
        const bool all = different.size() > 3 * free;
        for (; first < last; ++first)
        {
            const StretchElement& e = springs[first];
            const double own = given.value_or(rigid ? 0 : e.compliance);
            const double share = parts.contradictory[first]          ? kContradiction
                                 : all || parts.redundant[first] ? kRegularisation
                                                                 : 0;
            const double floor = share * h * h;
            out.push_back(std::max(own, floor * (b.inverse_mass[e.a] + b.inverse_mass[e.b])));
        }
    }
    return out;
}

double inverse_diagonal(const PlanBuilder& b, const StretchElement& e, double compliance)
{
    const double h = b.plan.timestep / b.plan.substeps;
    const double soft = std::min(compliance / (h * h), 1e30) / (1 + e.damping * compliance / h);
    return std::clamp(1 / (b.inverse_mass[e.a] + b.inverse_mass[e.b] + soft), 1e-30, 1e30);
}

std::uint32_t add_row_records(PlanBuilder& b, std::string_view effect,
                              const std::vector<StretchElement>& springs, std::span<const double> compliances)
{
    return with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::Spring<Real>> records = records_of(springs, spring_record<Real>);
        for (std::size_t k = 0; k < springs.size(); ++k)
            records[k].stiffness = row_stiffness<Real>(compliances[k]);
        return b.add_buffer<layout::Spring<Real>>(effect, "rows", records);
    });
}

void check_row_trips(const PlanBuilder& b, const Incidence& at, std::uint32_t chunk)
{
    const std::uint32_t lanes = TAUT_LINEAR_GROUP;
    for (std::uint32_t first = 0; first < b.plan.vertex_count; first += chunk)
        for (std::uint32_t lane = 0; lane < std::min(lanes, chunk); ++lane)
        {
            std::uint64_t trips = 0;
            for (std::uint32_t v = first + lane; v < std::min(first + chunk, b.plan.vertex_count); v += lanes)
                trips += at.start[v + 1] - at.start[v] + 1;
            if (trips > kMaxLoopTrips)
                throw Error(ErrorCode::limit,
                            std::to_string(trips) +
                                " constraints meet at one vertex, or at the few that one "
                                "invocation gathers, and " +
                                std::to_string(kMaxLoopTrips) +
                                " are the most; take method.type \"xpbd\", which splits hubs");
        }
}

void prepare_implicit_constraints(PlanBuilder& b)
{
    auto c = std::make_shared<ImplicitConstraints>();
    c->elements = all_springs(b);
    std::erase_if(c->elements, [&](const StretchElement& e) { return !may_be_constrained(b.scene, e); });
    if (c->elements.empty())
        return;
    add_row_buffers(b, *c);
    std::shared_ptr<const linear::Operator> system;
    if (b.scene.method.linear_operator == LinearOperator::assembled)
    {
        make_matrix(b, *c);
        system = c->matrix->matrix();
    }
    else
    {
        c->rows.spread = b.add_buffer(kImplicitConstraintsEffect, "moves of vertices",
                                      b.plan.vertex_count * 4 * b.real_size());
        system = std::make_shared<ConstraintOperator>(b, c->rows);
    }
    c->solve.emplace(
        b, kImplicitConstraintsEffect, system,
        linear::Preconditioning{linear::Preconditioner::jacobi, diagonal_inverse(b, *c), nullptr});
    b.plan.kept.push_back(c->solve->x());
    if (c->multiplier != kNoBuffer)
        b.plan.kept.push_back(c->multiplier);
    b.implicit_constraints = std::move(c);
}

void record_implicit_constraints(PlanBuilder& b, const Moment& moment)
{
    if (!b.implicit_constraints)
        return;
    ImplicitConstraints& c = *b.implicit_constraints;
    const std::uint32_t groups = groups_of(b, c), count = c.rows.count, all = c.rows.all();
    if (c.multiplier != kNoBuffer)
    {
        const kernels::constraint_total::Bindings<Use> uses = {
            .x = {c.solve->x()}, .multiplier = {c.multiplier}, .state = {c.solve->state(), 0}};
        b.dispatch(kImplicitConstraintsEffect, "", uses, {all, moment.iteration == 0}, all);
    }
    kernels::constraint_rows::Bindings<Use> uses = {.row = {c.rows.records},
                                                    .position = {b.plan.position, 2},
                                                    .delta = {b.plan.delta, 2},
                                                    .step_values = {b.plan.step_values, 0},
                                                    .events = {b.plan.events, 0},
                                                    .direction = {c.rows.direction},
                                                    .b = {c.solve->b()}};
    if (c.multiplier != kNoBuffer)
        uses.multiplier = {c.multiplier};
    const std::uint32_t chunk = linear::make_grid(count, groups).chunk;
    b.dispatch(kImplicitConstraintsEffect, c.multiplier != kNoBuffer ? "kept" : "", uses,
               {count, chunk, moment.iteration > 0, moment.last, b.plan.iterations == 1}, groups, count);
    record_corner_rows(b, kImplicitConstraintsEffect, c.corners, c.rows, *c.solve, c.multiplier, groups,
                       moment);
    if (c.matrix)
        c.matrix->record(b);
    c.solve->record(b);
    const linear::Grid grid = linear::make_grid(b.plan.vertex_count, groups);
    const kernels::constraint_spread::Bindings<Use> moved = {.start = {c.rows.start},
                                                             .incident = {c.rows.incident, 12},
                                                             .direction = {c.rows.direction, 12},
                                                             .x = {c.solve->x(), 12},
                                                             .position = {b.plan.position},
                                                             .delta = {b.plan.delta},
                                                             .state = {c.solve->state(), 0}};
    b.dispatch(kImplicitConstraintsEffect, "apply", moved, {grid.count, grid.chunk}, groups, grid.count);
    const CornerRows& v = c.rows.corners;
    if (v.count == 0)
        return;
    const kernels::corner_spread::Bindings<Use> also = {.start = {v.start},
                                                        .incident = {v.incident, 24},
                                                        .gradient = {v.gradient, 24},
                                                        .x = {c.solve->x(), 24},
                                                        .position = {b.plan.position},
                                                        .delta = {b.plan.delta},
                                                        .state = {c.solve->state(), 0}};
    b.dispatch(kImplicitConstraintsEffect, "apply", also, {grid.count, grid.chunk, count}, groups,
               grid.count);
}

} // namespace taut
