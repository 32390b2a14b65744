// Distance and bending constraints: from materials to coloured records and passes.
//
// Based on: Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics.
//   Computer Graphics Forum 34(2), 2015: one dispatch per colour, Gauss-Seidel inside.
// Departures: bodies are coloured on their own and colour k of every body shares a dispatch, so that a
//   body moves bitwise as it would alone; runs of small colours share one group (the tail rule);
//   vertices of very many distance constraints leave the colouring (kernels/constraints/hub.comp).

#include "taut/plan/constraints.hpp"

#include "taut/plan/material.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/kernels/bending.hpp"
#include "taut/kernels/distance.hpp"
#include "taut/kernels/hub.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace taut {
namespace {

/// Loop trips of one invocation in one dispatch; software Vulkan stops silently at 65,535.
constexpr std::uint32_t kMaxLoopTrips = 32000;

/// Records of all bodies by colour, and hubs after them.
template <typename Element>
struct Coloured
{
    std::vector<std::vector<Element>> colours;
    std::vector<std::vector<Element>> hubs;

    void add(const std::vector<Element>& elements, const Colouring& colouring)
    {
        colours.resize(std::max(colours.size(), colouring.colour_count()));
        for (std::size_t c = 0; c < colouring.colour_count(); ++c)
            for (std::uint32_t k = colouring.colour_start[c]; k < colouring.colour_start[c + 1]; ++k)
                colours[c].push_back(elements[colouring.order[k]]);
    }
};

ConstraintSet lay_out(std::string_view kind, const auto& coloured, auto& flat)
{
    ConstraintSet set;
    set.kind = std::string(kind);
    set.colour_start.push_back(0);
    for (const auto& colour : coloured.colours)
    {
        if (colour.empty())
            continue;
        flat.insert(flat.end(), colour.begin(), colour.end());
        set.colour_start.push_back(static_cast<std::uint32_t>(flat.size()));
    }
    if (!coloured.hubs.empty())
        set.hub_start.push_back(static_cast<std::uint32_t>(flat.size()));
    for (const auto& hub : coloured.hubs)
    {
        flat.insert(flat.end(), hub.begin(), hub.end());
        set.hub_start.push_back(static_cast<std::uint32_t>(flat.size()));
    }
    set.count = static_cast<std::uint32_t>(flat.size());
    return set;
}

void add_buffers(PlanBuilder& b, ConstraintSet& set)
{
    if (b.plan.iterations > 1 || b.options.residuals)
        set.multipliers = b.add_buffer(set.kind, set.kind + " multipliers", set.count * b.real_size());
    set.colour_table = b.add_buffer<std::uint32_t>(set.kind, set.kind + " colours", set.colour_start);
    b.plan.constraints.push_back(set);
}

/// Splits the constraints of a hub so that no part holds two with the same other end.
void add_hubs(Coloured<StretchElement>& out, const std::vector<StretchElement>& elements, const Colouring& colouring)
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

/// Springs of a body in plan vertices; those between two held vertices never act and are left out.
std::vector<StretchElement> moving_stretch(PlanBuilder& b, std::size_t body, bool& only_grid_edges)
{
    std::vector<StretchElement> elements;
    std::size_t conflicts = 0;
    only_grid_edges = b.scene.bodies[body].mesh.grid_columns > 0 && b.scene.bodies[body].springs.empty();
    for (StretchElement e : stretch_elements(b.scene.bodies[body]))
    {
        e.a = b.vertex(body, e.a);
        e.b = b.vertex(body, e.b);
        if (b.inverse_mass[e.a] > 0 || b.inverse_mass[e.b] > 0)
            elements.push_back(e);
        else
            conflicts += std::abs(glm::length(b.start[e.a] - b.start[e.b]) - e.rest_length) > 1e-6 * e.rest_length;
    }
    if (conflicts > 0)
        b.plan.warnings.push_back("conflict: " + std::to_string(conflicts) +
                                  " violated constraints between held vertices of body " + std::to_string(body));
    return elements;
}

Colouring stretch_colouring(const PlanBuilder& b, std::size_t body, const std::vector<StretchElement>& elements, bool grid)
{
    const std::uint32_t first = b.plan.body_start[body];
    if (grid)
    {
        std::vector<std::array<std::uint32_t, 2>> edges;
        for (const StretchElement& e : elements)
            edges.push_back({std::min(e.a, e.b) - first, std::max(e.a, e.b) - first});
        return grid_edge_colouring(edges, b.scene.bodies[body].mesh.grid_columns);
    }
    ConstraintGraph graph;
    graph.vertex_count = b.plan.vertex_count;
    for (const StretchElement& e : elements)
        graph.vertices.insert(graph.vertices.end(), {e.a, e.b});
    for (const double w : b.inverse_mass)
        graph.fixed.push_back(w == 0);
    return colour_greedy(graph);
}

/// Colours smaller than this gain nothing from more than one group: the device's cost of a dispatch
/// against that of a phase and of lanes that work alone.
std::uint32_t small_colour(const DeviceTraits& traits)
{
    const double gain = traits.dispatch_ns - traits.group_barrier_ns;
    const double loss = std::max(traits.lane_element_ns - traits.element_ns, 1e-3);
    return static_cast<std::uint32_t>(std::clamp(gain / loss, 0.0, 4096.0));
}

/// Passes of one sweep. `Params` is {first, count, first_iteration, report} for every constraint kernel.
template <typename Params>
void record_colours(PlanBuilder& b, const ConstraintSet& set, std::uint32_t vertices_each, const Moment& moment)
{
    const bool keep = set.multipliers != kNoBuffer;
    const std::uint32_t limit = small_colour(b.traits);
    const std::uint32_t first_iteration = moment.iteration == 0;
    const std::uint32_t report = moment.last;
    const auto size = [&](std::uint32_t c) { return set.colour_start[c + 1] - set.colour_start[c]; };
    for (std::uint32_t c = 0; c < set.colour_count();)
    {
        std::uint32_t end = c;
        std::uint32_t trips = 0;
        while (end < set.colour_count() && size(end) <= limit && trips + size(end) / kGroupSize + 2 < kMaxLoopTrips)
            trips += size(end++) / kGroupSize + 2;
        std::vector<Use> uses = {{set.buffer}, {b.plan.position, vertices_each}, {b.plan.delta, vertices_each},
                                 {b.plan.step_values, 0}, {b.plan.events, 0}};
        const bool tail = end - c >= 2;
        if (tail)
            uses.push_back({set.colour_table});
        if (keep)
            uses.push_back({set.multipliers});
        if (tail)
            b.dispatch(set.kind, set.kind, keep ? "tail_lambda" : "tail", uses,
                       Params{c, end - c, first_iteration, report}, 1, set.colour_start[end] - set.colour_start[c]);
        else
            b.dispatch(set.kind, set.kind, keep ? "lambda" : "", uses,
                       Params{set.colour_start[c], size(c), first_iteration, report}, size(c));
        c = tail ? end : c + 1;
    }
}

void record_hubs(PlanBuilder& b, const ConstraintSet& set, const Moment& moment)
{
    const bool keep = set.multipliers != kNoBuffer;
    for (std::size_t h = 0; h + 1 < set.hub_start.size(); ++h)
    {
        std::vector<Use> uses = {{set.buffer}, {b.plan.position, 2}, {b.plan.delta, 2}, {b.plan.step_values, 0},
                                 {b.plan.events, 0}};
        if (keep)
            uses.push_back({set.multipliers});
        const std::uint32_t size = set.hub_start[h + 1] - set.hub_start[h];
        b.dispatch(set.kind, "hub", keep ? "lambda" : "", uses,
                   kernels::hub::Params{set.hub_start[h], size, moment.iteration == 0, moment.last}, 1, size);
    }
}

const ConstraintSet* find_set(const Plan& plan, std::string_view kind)
{
    for (const ConstraintSet& set : plan.constraints)
        if (set.kind == kind)
            return &set;
    return nullptr;
}

} // namespace

Colouring grid_edge_colouring(std::span<const std::array<std::uint32_t, 2>> edges, std::uint32_t columns)
{
    std::vector<GridSpring> springs;
    for (const auto& [a, b] : edges)
    {
        const std::uint32_t step = b - a, row = a / columns, column = a % columns;
        // A grid of two columns has steps 1 (also columns - 1): along the row when both ends are in it.
        const bool along_row = row == b / columns;
        const std::uint32_t kind = along_row ? 0 : step == columns ? 2 : step == columns + 1 ? 4 : 6;
        springs.push_back({a, b, static_cast<std::uint8_t>(kind + (kind == 0 ? column % 2 : row % 2))});
    }
    return colouring_of(springs);
}

void prepare_distance(PlanBuilder& b)
{
    Coloured<StretchElement> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        bool grid = false;
        const std::vector<StretchElement> elements = moving_stretch(b, body, grid);
        const Colouring colouring = stretch_colouring(b, body, elements, grid);
        coloured.add(elements, colouring);
        add_hubs(coloured, elements, colouring);
    }
    std::vector<StretchElement> flat;
    ConstraintSet set = lay_out("distance", coloured, flat);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::DistanceConstraint<Real>> records;
        for (const StretchElement& e : flat)
            records.push_back({e.a, e.b, static_cast<Real>(e.rest_length), static_cast<Real>(e.compliance)});
        set.buffer = b.add_buffer<layout::DistanceConstraint<Real>>(set.kind, "distance constraints", records);
    });
    add_buffers(b, set);
}

void prepare_bending(PlanBuilder& b)
{
    Coloured<BendElement> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        std::size_t dropped = 0;
        std::vector<BendElement> elements;
        ConstraintGraph graph;
        graph.vertex_count = b.plan.vertex_count;
        graph.stride = 4;
        for (BendElement e : bend_elements(b.scene.bodies[body], &dropped))
        {
            for (std::uint32_t* v : {&e.edge0, &e.edge1, &e.wing0, &e.wing1})
                *v = b.vertex(body, *v);
            if (b.inverse_mass[e.edge0] + b.inverse_mass[e.edge1] + b.inverse_mass[e.wing0] + b.inverse_mass[e.wing1] == 0)
                continue;
            elements.push_back(e);
            graph.vertices.insert(graph.vertices.end(), {e.edge0, e.edge1, e.wing0, e.wing1});
        }
        for (const double w : b.inverse_mass)
            graph.fixed.push_back(w == 0);
        // Hinges round a hub share its neighbours too, so they stay in the colouring, one after another.
        coloured.add(elements, colour_greedy(graph, {0, true}));
        if (dropped > 0)
            b.plan.warnings.push_back("degenerate: " + std::to_string(dropped) + " hinges without area at rest in body " +
                                      std::to_string(body));
    }
    std::vector<BendElement> flat;
    ConstraintSet set = lay_out("bending", coloured, flat);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::BendingConstraint<Real>> records;
        for (const BendElement& e : flat)
            records.push_back({e.edge0, e.edge1, e.wing0, e.wing1, static_cast<Real>(e.rest_angle),
                               static_cast<Real>(e.compliance)});
        set.buffer = b.add_buffer<layout::BendingConstraint<Real>>(set.kind, "bending constraints", records);
    });
    add_buffers(b, set);
}

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
