// Distance and bending constraints: from materials to coloured records and passes.
//
// Based on: Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics.
//   Computer Graphics Forum 34(2), 2015: one dispatch per colour, Gauss-Seidel inside.
// Departures: bodies are coloured on their own and colour k of every body shares a dispatch, so that a
//   body moves bitwise as it would alone; runs of small colours share one group (the tail rule), and a
//   small body among many has a group of its own, where the device's costs say so;
//   vertices of very many distance constraints leave the colouring (kernels/constraints/hub.comp).

#include "taut/plan/constraints.hpp"

#include "taut/plan/grouping.hpp"
#include "taut/plan/springs.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/kernels/bending.hpp"
#include "taut/kernels/distance.hpp"
#include "taut/kernels/hub.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

void add_buffers(PlanBuilder& b, ConstraintSet& set, std::vector<std::uint32_t> table, bool multipliers)
{
    if (multipliers && (b.plan.iterations > 1 || b.options.residuals))
        set.multipliers = b.add_buffer(set.kind, set.kind + " multipliers", set.count * b.real_size());
    bool grouped = set.small_bodies > 0;
    for (const Run& run : runs_of(b, set))
        if (run.grouped())
        {
            table.insert(table.end(), {run.begin, run.end});
            grouped = true;
        }
    if (grouped)
        set.table = b.add_buffer<std::uint32_t>(set.kind, set.kind + " colours", table);
    b.plan.constraints.push_back(set);
}

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

/// A graph over one body's plan vertices, counted from its first, without constraints yet. Held vertices
/// conflict like others: kernels write both ends of a constraint.
ConstraintGraph body_graph(const PlanBuilder& b, std::size_t body, std::uint32_t stride)
{
    ConstraintGraph graph;
    graph.vertex_count = b.plan.body_start[body + 1] - b.plan.body_start[body];
    graph.stride = stride;
    return graph;
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
        for (const StretchElement& e : elements)
            edges.push_back({std::min(e.a, e.b) - first, std::max(e.a, e.b) - first});
        return grid_edge_colouring(edges, b.scene.bodies[body].mesh.grid_columns);
    }
    ConstraintGraph graph = body_graph(b, body, 2);
    for (const StretchElement& e : elements)
        graph.vertices.insert(graph.vertices.end(), {e.a - first, e.b - first});
    Colouring colouring = colour_greedy(graph, {hub_degree, true});
    for (std::uint32_t& hub : colouring.hubs)
        hub += first;
    return colouring;
}

bool is_damped(const PlanBuilder& b, const ConstraintSet& set)
{
    return set.kind == "distance" && b.distance_damping != kNoBuffer;
}

/// What the springs' dampers need, where there are any.
void add_damping(PlanBuilder& b, const ConstraintSet& set, const std::vector<StretchElement>& flat)
{
    if (std::none_of(flat.begin(), flat.end(), [](const StretchElement& e) { return e.damping > 0; }))
        return;
    if (!set.hub_start.empty())
        throw Error(ErrorCode::unsupported,
                    "stretch_damping with more than " + std::to_string(ColouringOptions{}.hub_degree) +
                        " springs at one vertex; xpbd solves those at once and without dampers: use "
                        "stretch_damping 0, or another method");
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<Real> times;
        for (const StretchElement& e : flat)
            times.push_back(static_cast<Real>(e.damping * e.compliance));
        b.distance_damping = b.add_buffer<Real>(set.kind, "damping times", times);
    });
}

std::vector<Use> uses_of(const PlanBuilder& b, const ConstraintSet& set, std::uint32_t vertices_each,
                         bool grouped)
{
    std::vector<Use> uses = {{set.buffer}, {b.plan.position, vertices_each}, {b.plan.delta, vertices_each},
                             {b.plan.step_values, 0}, {b.plan.events, 0}};
    if (grouped)
        uses.push_back({set.table});
    if (set.multipliers != kNoBuffer)
        uses.push_back({set.multipliers});
    if (is_damped(b, set))
        uses.push_back({b.distance_damping});
    return uses;
}

/// Passes of one sweep. `Params` is {first, count, first_iteration, report} for every constraint kernel.
template <typename Params>
void record_colours(PlanBuilder& b, const ConstraintSet& set, std::uint32_t vertices_each,
                    const Moment& moment)
{
    const bool keep = set.multipliers != kNoBuffer;
    const bool damped = is_damped(b, set);
    const std::string_view alone = damped ? (keep ? "damped_lambda" : "damped") : (keep ? "lambda" : "");
    const std::string_view grouped =
        damped ? (keep ? "damped_tail_lambda" : "damped_tail") : (keep ? "tail_lambda" : "tail");
    const std::uint32_t first_iteration = moment.iteration == 0, report = moment.last;
    std::uint32_t range = first_run_range(set);
    for (const Run& run : runs_of(b, set))
    {
        const std::uint32_t first = set.colour_start[run.begin], size = set.colour_start[run.end] - first;
        const std::vector<Use> uses = uses_of(b, set, vertices_each, run.grouped());
        if (run.grouped())
            b.dispatch(set.kind, set.kind, grouped, uses, Params{range, 1, first_iteration, report}, 1, size);
        else
            b.dispatch(set.kind, set.kind, alone, uses, Params{first, size, first_iteration, report}, size);
        range += run.grouped() ? 2 : 0;
    }
    if (set.small_bodies > 0)
        b.dispatch(set.kind, set.kind, grouped, uses_of(b, set, vertices_each, true),
                   Params{set.small_range, set.small_bodies, first_iteration, report}, set.small_bodies,
                   set.small_constraints);
}

void record_hubs(PlanBuilder& b, const ConstraintSet& set, const Moment& moment)
{
    const bool keep = set.multipliers != kNoBuffer;
    for (std::size_t h = 0; h + 1 < set.hub_start.size(); ++h)
    {
        std::vector<Use> uses = {{set.buffer},
                                 {b.plan.position, 2},
                                 {b.plan.delta, 2},
                                 {b.plan.step_values, 0},
                                 {b.plan.events, 0}};
        if (keep)
            uses.push_back({set.multipliers});
        const std::uint32_t size = set.hub_start[h + 1] - set.hub_start[h];
        b.dispatch(set.kind, "hub", keep ? "lambda" : "", uses,
                   kernels::hub::Params{set.hub_start[h], size, moment.iteration == 0, moment.last}, 1, size);
    }
}

} // namespace

Colouring grid_edge_colouring(std::span<const std::array<std::uint32_t, 2>> edges, std::uint32_t columns)
{
    std::vector<GridSpring> springs;
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
    ConstraintSet set = lay_out(options.kind, coloured, flat, table);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::DistanceConstraint<Real>> records;
        for (const StretchElement& e : flat)
            records.push_back({e.a, e.b, static_cast<Real>(e.rest_length), static_cast<Real>(e.compliance)});
        set.buffer =
            b.add_buffer<layout::DistanceConstraint<Real>>(set.kind, set.kind + " constraints", records);
    });
    if (options.kind == "distance")
        add_damping(b, set, flat);
    add_buffers(b, set, std::move(table), options.multipliers);
}

void prepare_hinges(PlanBuilder& b, const SetOptions& options)
{
    Coloured<BendElement> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        ConstraintGraph graph = body_graph(b, body, 4);
        const std::uint32_t first = b.plan.body_start[body];
        const std::vector<BendElement> elements = acting_hinges(b, body);
        for (const BendElement& e : elements)
            for (const std::uint32_t v : {e.edge0, e.edge1, e.wing0, e.wing1})
                graph.vertices.push_back(v - first);
        // Hinges round a hub share its neighbours too, so they stay in the colouring, one after another.
        add_body(b, coloured, elements, colour_greedy(graph, {0, true}));
    }
    std::vector<BendElement> flat;
    std::vector<std::uint32_t> table;
    ConstraintSet set = lay_out(options.kind, coloured, flat, table);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::BendingConstraint<Real>> records;
        for (const BendElement& e : flat)
            records.push_back({e.edge0, e.edge1, e.wing0, e.wing1, static_cast<Real>(e.rest_angle),
                               static_cast<Real>(e.compliance)});
        set.buffer =
            b.add_buffer<layout::BendingConstraint<Real>>(set.kind, set.kind + " constraints", records);
    });
    add_buffers(b, set, std::move(table), options.multipliers);
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

void prepare_bending(PlanBuilder& b) { prepare_hinges(b, {"bending", true}); }

void record_distance(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "distance"))
    {
        record_colours<kernels::distance::Params>(b, *set, 2, moment);
        record_hubs(b, *set, moment);
    }
}

void record_bending(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "bending"))
        record_colours<kernels::bending::Params>(b, *set, 4, moment);
}

} // namespace taut
