// Distance and bending constraints: from materials to coloured records and passes.
//
// Based on: Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics.
//   Computer Graphics Forum 34(2), 2015: one dispatch per colour, Gauss-Seidel inside.
// Departures: bodies are coloured on their own and colour k of every body shares a dispatch, so that a
//   body moves bitwise as it would alone; runs of small colours share one group (the tail rule), and a
//   small body among many has a group of its own, where the device's costs say so;
//   vertices of very many distance constraints leave the colouring (kernels/methods/xpbd/xpbd_hub.comp).

#include "taut/plan/constraints.hpp"

#include "taut/plan/coloured_set.hpp"
#include "taut/plan/plate.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/springs.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/kernels/xpbd_hinge.hpp"
#include "taut/kernels/xpbd_spring.hpp"
#include "taut/kernels/xpbd_hub_spring.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

/// Splits the constraints of a hub so that no part holds two with the same other end.
void add_hubs(Coloured<StretchElement>& out, const std::vector<StretchElement>& elements,
              const Colouring& colouring)
{
    for (std::size_t h = 0; h < colouring.hubs.size(); ++h)
    {
        std::vector<StretchElement> rest;
        for (std::uint32_t k = colouring.hub_start[h]; k < colouring.hub_start[h + 1]; ++k)
        {
            StretchElement e = elements[colouring.hub_constraints[k]];
            if (e.a != colouring.hubs[h])
                std::swap(e.a, e.b);
            rest.push_back(e);
        }
        while (!rest.empty())
        {
            std::set<std::uint32_t> ends;
            std::vector<StretchElement> part, later;
            for (const StretchElement& e : rest)
                (ends.insert(e.b).second ? part : later).push_back(e);
            out.hubs.push_back(std::move(part));
            rest = std::move(later);
        }
    }
}

/// The edges of a grid, or the springs of its network, and nothing else.
bool is_grid(const Body& body)
{
    return body.mesh.grid_columns > 0 &&
           std::none_of(body.springs.begin(), body.springs.end(),
                        [](const Body::Spring& s) { return s.kind == SpringKind::extra; });
}

Colouring stretch_colouring(const PlanBuilder& b, std::size_t body,
                            const std::vector<StretchElement>& elements, std::uint32_t hub_degree)
{
    const std::uint32_t first = b.plan.body_start[body];
    if (is_grid(b.scene.bodies[body]))
    {
        std::vector<std::array<std::uint32_t, 2>> edges;
        edges.reserve(elements.size());
        for (const StretchElement& e : elements)
            edges.push_back({std::min(e.a, e.b) - first, std::max(e.a, e.b) - first});
        return grid_edge_colouring(edges, b.scene.bodies[body].mesh.grid_columns);
    }
    ConstraintGraph graph = body_graph(b, body, 2);
    graph.vertices.reserve(2 * elements.size());
    for (const StretchElement& e : elements)
        graph.vertices.insert(graph.vertices.end(), {e.a - first, e.b - first});
    Colouring colouring = colour_greedy(graph, {hub_degree, true});
    for (std::uint32_t& hub : colouring.hubs)
        hub += first;
    return colouring;
}

/// What the springs' dampers need, where there are any.
void add_damping(PlanBuilder& b, ConstraintSet& set, const std::vector<StretchElement>& flat)
{
    if (std::none_of(flat.begin(), flat.end(), [](const StretchElement& e) { return e.damping > 0; }))
        return;
    if (!set.hub_start.empty())
        throw Error(ErrorCode::unsupported,
                    "method.type is \"xpbd\", but more than " +
                        std::to_string(ColouringOptions{}.hub_degree) +
                        " springs with a stretch_damping meet at one vertex; xpbd solves those at once and "
                        "without dampers: use stretch_damping 0, or another method");
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<Real> times;
        for (const StretchElement& e : flat)
            times.push_back(static_cast<Real>(e.damping * e.compliance));
        set.damping = b.add_buffer<Real>(set.kind, "damping times", times);
    });
}

void record_hubs(PlanBuilder& b, const ConstraintSet& set, const Moment& moment)
{
    const kernels::xpbd_hub_spring::Bindings<Use> uses = {.constraint = {set.buffer},
                                              .position = {b.plan.position, 2},
                                              .delta = {b.plan.delta, 2},
                                              .step_values = {b.plan.step_values, 0},
                                              .events = {b.plan.events, 0},
                                              .multiplier = {set.multipliers}};
    for (std::size_t h = 0; h + 1 < set.hub_start.size(); ++h)
    {
        const std::uint32_t size = set.hub_start[h + 1] - set.hub_start[h];
        b.dispatch(set.kind, uses.multiplier.is_set() ? "lambda" : "", uses,
                   {set.hub_start[h], size, moment.iteration == 0, moment.last}, 1, size);
    }
}

/// What the passes of a set bind; multipliers and dampers where it has them.
kernels::xpbd_spring::Bindings<Use> uses_of(const PlanBuilder& b, const ConstraintSet& set,
                                            std::uint32_t vertices_each, bool grouped)
{
    kernels::xpbd_spring::Bindings<Use> uses = {.constraint = {set.buffer},
                                                .position = {b.plan.position, vertices_each},
                                                .delta = {b.plan.delta, vertices_each},
                                                .step_values = {b.plan.step_values, 0},
                                                .events = {b.plan.events, 0},
                                                .multiplier = {set.multipliers},
                                                .damping_time = {set.damping}};
    if (grouped)
        uses.table = {set.table};
    return uses;
}

} // namespace

void record_colours(PlanBuilder& b, const ConstraintSet& set, std::string_view kernel,
                    std::uint32_t vertices_each, const Moment& moment)
{
    const bool damped = set.damping != kNoBuffer;
    const bool keep = set.multipliers != kNoBuffer;
    const std::string_view alone = damped ? (keep ? "damped_lambda" : "damped") : (keep ? "lambda" : "");
    const std::string_view grouped =
        damped ? (keep ? "damped_tail_lambda" : "damped_tail") : (keep ? "tail_lambda" : "tail");
    const std::uint32_t first_iteration = moment.iteration == 0, report = moment.last;
    const auto uses = uses_of(b, set, vertices_each, false), group = uses_of(b, set, vertices_each, true);
    std::uint32_t range = first_run_range(set);
    for (const Run& run : runs_of(b, set))
    {
        const std::uint32_t first = set.colour_start[run.begin], size = set.colour_start[run.end] - first;
        b.stands_for(run.end - run.begin);
        if (run.grouped())
            b.dispatch_by_name(set.kind, kernel, grouped, group, {range, 1, first_iteration, report}, 1,
                               size);
        else
            b.dispatch_by_name(set.kind, kernel, alone, uses, {first, size, first_iteration, report}, size);
        range += run.grouped() ? 2 : 0;
    }
    if (set.small_bodies > 0)
    {
        stand_for_small(b, set);
        b.dispatch_by_name(set.kind, kernel, grouped, group,
                           {set.small_range, set.small_bodies, first_iteration, report}, set.small_bodies,
                           set.small_constraints);
    }
}

ConstraintGraph body_graph(const PlanBuilder& b, std::size_t body, std::uint32_t stride)
{
    ConstraintGraph graph;
    graph.vertex_count = b.plan.body_start[body + 1] - b.plan.body_start[body];
    graph.stride = stride;
    return graph;
}

void add_set(PlanBuilder& b, ConstraintSet& set, std::vector<std::uint32_t> table, const SetOptions& options,
             std::uint32_t each)
{
    if (options.multipliers && (b.plan.iterations > 1 || b.options.residuals || options.keeps))
        set.multipliers = b.add_buffer(set.kind, set.kind + " multipliers",
                                       std::uint64_t(set.count) * each * b.real_size());
    add_colour_table(b, set, std::move(table));
    b.plan.constraints.push_back(set);
}

Colouring grid_edge_colouring(std::span<const std::array<std::uint32_t, 2>> edges, std::uint32_t columns)
{
    std::vector<GridSpring> springs;
    springs.reserve(edges.size());
    for (const auto& [a, b] : edges)
    {
        const std::uint32_t row = a / columns, column = a % columns;
        const std::uint32_t down = b / columns - row;
        const auto right = static_cast<std::int32_t>(b % columns) - static_cast<std::int32_t>(column);
        // One of six directions; the parity of where it starts, in steps of its own length, does the rest.
        const std::uint32_t direction = down == 0    ? (right == 1 ? 0 : 4)
                                        : right == 0 ? (down == 1 ? 1 : 5)
                                                     : (right > 0 ? 2 : 3);
        const std::uint32_t step = direction == 0   ? column
                                   : direction == 4 ? column / 2
                                   : direction == 5 ? row / 2
                                                    : row;
        springs.push_back({a, b, static_cast<std::uint8_t>(2 * direction + step % 2)});
    }
    return colouring_of(springs);
}

void prepare_springs(PlanBuilder& b, const SetOptions& options)
{
    Coloured<StretchElement> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const std::vector<StretchElement> elements = acting_springs(b, body);
        const Colouring colouring = stretch_colouring(b, body, elements, options.hub_degree);
        add_body(b, coloured, elements, colouring);
        add_hubs(coloured, elements, colouring);
    }
    std::vector<StretchElement> flat;
    std::vector<std::uint32_t> table;
    ConstraintSet set = lay_out(options.kind, std::move(coloured), flat, table);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        set.buffer = b.add_buffer<layout::DistanceConstraint<Real>>(set.kind, set.kind + " constraints",
                                                                    records_of(flat, distance_record<Real>));
    });
    if (options.kind == "distance")
        add_damping(b, set, flat);
    add_set(b, set, std::move(table), options);
}

void prepare_hinges(PlanBuilder& b, const SetOptions& options)
{
    prepare_set(
        b, options, 1, [&](std::size_t body) { return acting_hinges(b, body); },
        [](auto zero, const BendElement& e) { return bending_record<decltype(zero)>(e); });
}

const ConstraintSet* find_set(const Plan& plan, std::string_view kind)
{
    for (const ConstraintSet& set : plan.constraints)
        if (set.kind == kind)
            return &set;
    return nullptr;
}

void prepare_distance(PlanBuilder& b)
{
    prepare_springs(b, {"distance", true, ColouringOptions{}.hub_degree});
}

void prepare_bending(PlanBuilder& b)
{
    prepare_hinges(b, {"bending", true, 0, wants_plate(b.scene)}); // plates go by the moments
}

void record_distance(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "distance"))
    {
        record_colours(b, *set, "xpbd_spring", 2, moment);
        record_hubs(b, *set, moment);
    }
}

void record_bending(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "bending"))
        record_colours(b, *set, "xpbd_hinge", 4, moment);
}

} // namespace taut
