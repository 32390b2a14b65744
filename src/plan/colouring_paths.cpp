// Colours of edges (stride 2) exchanged along alternating paths, so that fewer colours are enough.
// Based on:
//   V. G. Vizing. On an estimate of the chromatic class of a p-graph. Diskret. Analiz 3, 1964;
//   J. Misra, D. Gries. A constructive proof of Vizing's theorem. Information Processing Letters
//   41(3), 1992: fan, path, rotation at colour_by_fan.
// Departures: only the edges that first fit put above degree + 1 are done; a fan ends as soon as a
// rotation helps; an end that does not move is an end of its own; where repeated pairs break the
// method, the edge gets the lowest colour that is free.

#include "colouring_parts.hpp"

namespace taut::colouring {

namespace {

class Paths
{
public:
    Paths(Assignment& assignment, std::uint32_t limit) : a_(assignment), limit_(limit) {}

    /// The two ends, kNone for one that does not move (or repeats the first).
    std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t edge) const
    {
        std::pair<std::uint32_t, std::uint32_t> out{kNone, kNone};
        for_each_moving(a_.graph, edge,
                        [&](std::uint32_t v) { (out.first == kNone ? out.first : out.second) = v; });
        return out;
    }

    std::uint32_t other_end(std::uint32_t edge, std::uint32_t v) const
    {
        const auto [first, second] = ends(edge);
        return first == v ? second : first;
    }

    /// The edge of a colour at a vertex, or kNone.
    std::uint32_t edge_of(std::uint32_t v, std::uint32_t colour) const
    {
        for (const std::uint32_t edge : v == kNone ? std::span<const std::uint32_t>() : a_.at_vertex.of(v))
        {
            if (a_.colour[edge] == colour)
            {
                return edge;
            }
        }
        return kNone;
    }

    /// Colours below the limit that no edge at v has, ascending.
    std::vector<std::uint32_t> free_at(std::uint32_t v) const
    {
        std::vector<bool> used(limit_, false);
        for (const std::uint32_t edge : v == kNone ? std::span<const std::uint32_t>() : a_.at_vertex.of(v))
        {
            if (a_.colour[edge] < limit_)
            {
                used[a_.colour[edge]] = true;
            }
        }
        std::vector<std::uint32_t> out;
        for (std::uint32_t k = 0; k < limit_; ++k)
        {
            if (!used[k])
            {
                out.push_back(k);
            }
        }
        return out;
    }

    /// Edges of alternating colours from v on, first `first`, then `second`; `end` is the last vertex.
    /// One of the two must be missing at v.
    std::vector<std::uint32_t> path(std::uint32_t v, std::uint32_t first, std::uint32_t second,
                                    std::uint32_t& end) const
    {
        std::vector<std::uint32_t> out;
        for (std::uint32_t edge = edge_of(v, first); edge != kNone; edge = edge_of(v, first))
        {
            out.push_back(edge);
            v = other_end(edge, v);
            std::swap(first, second);
        }
        end = v;
        return out;
    }

    void exchange(const std::vector<std::uint32_t>& edges, std::uint32_t first, std::uint32_t second)
    {
        for (const std::uint32_t edge : edges)
        {
            a_.colour[edge] = a_.colour[edge] == first ? second : first;
        }
    }

    bool colour_by_fan(std::uint32_t edge, std::uint32_t centre);

private:
    /// Each edge of the fan takes the colour of the next, the last takes `colour`.
    void rotate(const std::vector<std::uint32_t>& fan, std::size_t last, std::uint32_t colour)
    {
        for (std::size_t i = 0; i < last; ++i)
        {
            a_.colour[fan[i]] = a_.colour[fan[i + 1]];
        }
        a_.colour[fan[last]] = colour;
    }

    /// An edge at the centre, not in the fan, whose colour is one of `free`; kNone if there is none.
    std::uint32_t next_of(const std::vector<std::uint32_t>& fan, std::uint32_t centre,
                          const std::vector<std::uint32_t>& free) const
    {
        for (const std::uint32_t edge : a_.at_vertex.of(centre))
        {
            if (std::binary_search(free.begin(), free.end(), a_.colour[edge]) &&
                std::find(fan.begin(), fan.end(), edge) == fan.end())
            {
                return edge;
            }
        }
        return kNone;
    }

    bool rotate_prefix(const std::vector<std::uint32_t>& fan, std::uint32_t centre, std::uint32_t colour);

    Assignment& a_;
    std::uint32_t limit_;
};

/// Finds a part of the fan, from its start, that a path exchange left intact and whose last tip lacks
/// `colour`, and rotates it.
bool Paths::rotate_prefix(const std::vector<std::uint32_t>& fan, std::uint32_t centre, std::uint32_t colour)
{
    for (std::size_t i = 0; i < fan.size(); ++i)
    {
        if (i > 0 && edge_of(other_end(fan[i - 1], centre), a_.colour[fan[i]]) != kNone)
        {
            return false;
        }
        if (edge_of(other_end(fan[i], centre), colour) == kNone)
        {
            rotate(fan, i, colour);
            return true;
        }
    }
    return false;
}

bool Paths::colour_by_fan(std::uint32_t edge, std::uint32_t centre)
{
    const std::vector<std::uint32_t> free_here = free_at(centre);
    std::vector<std::uint32_t> fan, free_there;
    for (std::uint32_t next = edge; next != kNone; next = next_of(fan, centre, free_there))
    {
        fan.push_back(next);
        free_there = free_at(other_end(next, centre));
        const auto both =
            std::find_first_of(free_here.begin(), free_here.end(), free_there.begin(), free_there.end());
        if (both != free_here.end())
        {
            rotate(fan, fan.size() - 1, *both);
            return true;
        }
    }
    if (free_here.empty() || free_there.empty())
    {
        return false;
    }
    std::uint32_t end = kNone;
    const std::uint32_t ours = free_here.front(), theirs = free_there.front();
    exchange(path(centre, theirs, ours, end), theirs, ours);
    return rotate_prefix(fan, centre, theirs);
}

} // namespace

void shorten_by_fans(Assignment& assignment)
{
    const std::uint32_t limit = assignment.degree() + 1;
    if (assignment.count <= limit)
    {
        return;
    }
    std::vector<std::uint32_t> waiting;
    for (const std::uint32_t c : assignment.members)
    {
        if (assignment.colour[c] >= limit)
        {
            assignment.colour[c] = kNone;
            waiting.push_back(c);
        }
    }
    assignment.count = limit;
    Paths paths(assignment, limit);
    for (const std::uint32_t c : waiting)
    {
        const auto [u, v] = paths.ends(c);
        if (paths.colour_by_fan(c, u) || (v != kNone && paths.colour_by_fan(c, v)))
        {
            continue;
        }
        std::uint32_t colour = 0;
        while (paths.edge_of(u, colour) != kNone || paths.edge_of(v, colour) != kNone)
        {
            ++colour;
        }
        assignment.colour[c] = colour;
        assignment.count = std::max(assignment.count, colour + 1);
    }
}

bool exchange_colours(Assignment& assignment, std::uint32_t edge, std::uint32_t limit, std::size_t& budget)
{
    Paths paths(assignment, limit);
    const auto [u, v] = paths.ends(edge);
    const std::vector<std::uint32_t> free_there = paths.free_at(v);
    for (const std::uint32_t here : paths.free_at(u))
    {
        for (const std::uint32_t there : free_there)
        {
            // After the exchange along the path from v, `here` is free at both ends, unless the path
            // ends at u and takes it away there.
            std::uint32_t end = kNone;
            const std::vector<std::uint32_t> path = paths.path(v, here, there, end);
            const bool spent = path.size() + 1 >= budget;
            budget -= spent ? budget : path.size() + 1;
            if (path.empty() || end != u)
            {
                paths.exchange(path, here, there);
                assignment.colour[edge] = here;
                return true;
            }
            if (spent)
            {
                return false;
            }
        }
    }
    return false;
}

} // namespace taut::colouring
