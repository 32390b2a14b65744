#pragma once
// What the parts of the colouring share. Private to src/plan.

#include "taut/plan/colouring.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace taut::colouring {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Calls visit(vertex) for each moving vertex of a constraint, once each.
template <class Visit>
void for_each_moving(const ConstraintGraph& graph, std::uint32_t constraint, Visit visit)
{
    const std::uint32_t* first = graph.vertices.data() + std::size_t(constraint) * graph.stride;
    for (std::uint32_t k = 0; k < graph.stride; ++k)
    {
        const std::uint32_t v = first[k];
        assert(v < graph.vertex_count);
        const bool held = !graph.fixed.empty() && graph.fixed[v];
        if (!held && std::find(first, first + k, v) == first + k)
        {
            visit(v);
        }
    }
}

/// Lists in one array: list i is items[start[i]] .. items[start[i + 1] - 1].
struct Lists
{
    std::vector<std::uint32_t> start, items;
    std::span<const std::uint32_t> of(std::uint32_t i) const
    {
        return std::span(items).subspan(start[i], start[i + 1] - start[i]);
    }
};

/// A colouring on its way: a colour for each constraint, kNone for those at hubs.
struct Assignment
{
    const ConstraintGraph& graph;
    std::vector<std::uint32_t> members; ///< the coloured constraints, ascending
    Lists at_vertex;                    ///< the coloured constraints of each moving vertex, ascending
    std::vector<std::uint32_t> colour;  ///< by constraint
    std::uint32_t count = 0;            ///< colours in use

    std::uint32_t degree() const; ///< of the coloured constraints at one vertex, the largest number
};

/// First fit in the order of `members`; sets colour and count.
void first_fit(Assignment& assignment);

/// Stride 2: recolours along alternating paths until degree + 1 colours are enough (or, with repeated
/// pairs, as few as the method finds).
void shorten_by_fans(Assignment& assignment);

/// Stride 2: tries to give an edge one of the colours 0..limit-1 by exchanging two colours along one
/// path. Other edges may change, the colouring stays valid. False if no exchange helps. Takes the
/// edges it looked at from `budget` and gives up when none is left.
bool exchange_colours(Assignment& assignment, std::uint32_t edge, std::uint32_t limit, std::size_t& budget);

/// Empties the last colours where their members fit elsewhere, then moves members from large to small
/// feasible colours.
void balance(Assignment& assignment);

} // namespace taut::colouring
