// Greedy colouring of constraints, with hubs left out.
// Based on:
//   M. Fratarcangeli, F. Pellacini. Scalable Partitioning for Parallel Position Based Dynamics.
//   Eurographics 2015: one colour at a time, Gauss-Seidel between colours.
// Departures: first fit in the given order; vertices of high degree leave the colouring, because each
// constraint there would need a colour of its own.

#include "colouring_parts.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace taut {

namespace colouring {

namespace {

constexpr std::uint32_t kWordBits = 64;

std::vector<std::uint32_t> vertex_degrees(const ConstraintGraph& graph)
{
    std::vector<std::uint32_t> degree(graph.vertex_count, 0);
    for (std::uint32_t c = 0; c < graph.size(); ++c)
    {
        for_each_moving(graph, c, [&](std::uint32_t v) { ++degree[v]; });
    }
    return degree;
}

/// Constraints by hub, in the order of the hubs; the rest become `members`.
void split_hubs(const ConstraintGraph& graph, std::uint32_t hub_degree, Colouring& out,
                std::vector<std::uint32_t>& members)
{
    const std::vector<std::uint32_t> degree = vertex_degrees(graph);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> owned; // hub, constraint
    for (std::uint32_t c = 0; c < graph.size(); ++c)
    {
        std::uint32_t hub = kNone;
        for_each_moving(graph, c, [&](std::uint32_t v) {
            hub = hub_degree > 0 && degree[v] > hub_degree ? std::min(hub, v) : hub;
        });
        if (hub == kNone)
        {
            members.push_back(c);
        }
        else
        {
            owned.emplace_back(hub, c);
        }
    }
    std::sort(owned.begin(), owned.end());
    out.hub_start = {0};
    for (const auto& [hub, constraint] : owned)
    {
        if (out.hubs.empty() || out.hubs.back() != hub)
        {
            out.hubs.push_back(hub);
            out.hub_start.push_back(out.hub_start.back());
        }
        out.hub_constraints.push_back(constraint);
        ++out.hub_start.back();
    }
}

Lists lists_at_vertices(const ConstraintGraph& graph, const std::vector<std::uint32_t>& members)
{
    Lists lists;
    lists.start.assign(graph.vertex_count + std::size_t(1), 0);
    for (const std::uint32_t c : members)
    {
        for_each_moving(graph, c, [&](std::uint32_t v) { ++lists.start[v + 1]; });
    }
    std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
    lists.items.resize(lists.start.back());
    std::vector<std::uint32_t> next(lists.start.begin(), lists.start.end() - 1);
    for (const std::uint32_t c : members)
    {
        for_each_moving(graph, c, [&](std::uint32_t v) { lists.items[next[v]++] = c; });
    }
    return lists;
}

/// Stable counting sort of `ids` by key(id) < key_count.
template <class Key>
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& ids, std::size_t key_count, Key key)
{
    std::vector<std::uint32_t> start(key_count + 1, 0);
    for (const std::uint32_t id : ids)
    {
        ++start[key(id) + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> out(ids.size());
    for (const std::uint32_t id : ids)
    {
        out[start[key(id)]++] = id;
    }
    return out;
}

void write_colours(const Assignment& assignment, Colouring& out)
{
    const ConstraintGraph& graph = assignment.graph;
    const auto lowest = [&](std::uint32_t c) {
        const std::uint32_t* first = graph.vertices.data() + std::size_t(c) * graph.stride;
        return *std::min_element(first, first + graph.stride);
    };
    const auto colour = [&](std::uint32_t c) { return assignment.colour[c]; };
    const auto along = sorted_by(assignment.members, graph.vertex_count, lowest);
    out.order = sorted_by(along, assignment.count, colour);
    out.colour_start.assign(assignment.count + std::size_t(1), 0);
    for (const std::uint32_t c : assignment.members)
    {
        ++out.colour_start[colour(c) + 1];
    }
    std::partial_sum(out.colour_start.begin(), out.colour_start.end(), out.colour_start.begin());
}

} // namespace

std::uint32_t Assignment::degree() const
{
    std::uint32_t largest = 0;
    for (std::size_t v = 0; v + 1 < at_vertex.start.size(); ++v)
    {
        largest = std::max(largest, at_vertex.start[v + 1] - at_vertex.start[v]);
    }
    return largest;
}

// Colours are handed out 64 at a time, so that one word a vertex is enough however many there are. A
// constraint that finds none of these 64 free waits for the next 64; the result is that of plain first
// fit, because whether colour k is free depends only on earlier constraints with colour k.
void first_fit(Assignment& assignment)
{
    std::vector<std::uint32_t> waiting = assignment.members, later;
    std::vector<std::uint64_t> taken(assignment.graph.vertex_count, 0);
    for (std::uint32_t base = 0; !waiting.empty(); base += kWordBits)
    {
        std::fill(taken.begin(), taken.end(), 0);
        later.clear();
        for (const std::uint32_t c : waiting)
        {
            std::uint64_t used = 0;
            for_each_moving(assignment.graph, c, [&](std::uint32_t v) { used |= taken[v]; });
            if (used == std::numeric_limits<std::uint64_t>::max())
            {
                later.push_back(c);
                continue;
            }
            const auto bit = static_cast<std::uint32_t>(std::countr_one(used));
            const std::uint64_t mask = std::uint64_t(1) << bit;
            for_each_moving(assignment.graph, c, [&](std::uint32_t v) { taken[v] |= mask; });
            assignment.colour[c] = base + bit;
            assignment.count = std::max(assignment.count, base + bit + 1);
        }
        std::swap(waiting, later);
    }
}

} // namespace colouring

Colouring colour_greedy(const ConstraintGraph& graph, const ColouringOptions& options)
{
    assert(graph.stride > 0 && graph.vertices.size() % graph.stride == 0);
    assert(graph.fixed.empty() || graph.fixed.size() == graph.vertex_count);
    Colouring out;
    colouring::Assignment assignment{graph, {}, {}, {}, 0};
    colouring::split_hubs(graph, options.hub_degree, out, assignment.members);
    assignment.at_vertex = colouring::lists_at_vertices(graph, assignment.members);
    assignment.colour.assign(graph.size(), colouring::kNone);
    colouring::first_fit(assignment);
    if (graph.stride == 2)
    {
        colouring::shorten_by_fans(assignment);
    }
    if (options.balance)
    {
        colouring::balance(assignment);
    }
    colouring::write_colours(assignment, out);
    return out;
}

} // namespace taut
