// Fewer and more even colours after a greedy colouring: a dispatch of a few constraints costs as much as
// one of thousands.
// Based on:
//   A. H. Gebremedhin, F. Manne, A. Pothen. What Color Is Your Jacobian? SIAM Review 47(4), 2005:
//   first-fit colourings and their improvement by recolouring.
// Departures: a small class is dissolved by moving what blocks its members, one level deep (stride 2:
// also along alternating paths); then members of large classes go to the smallest feasible one.

#include "colouring_parts.hpp"

#include <algorithm>
#include <set>

namespace taut::colouring {

namespace {

constexpr std::size_t kExchangeEffort = 4; ///< edges looked at on paths, for each constraint

class Balancer
{
public:
    explicit Balancer(Assignment& assignment) : a_(assignment), blocker_stamp_(assignment.count, 0)
    {
        budget_ = kExchangeEffort * a_.members.size();
    }

    void dissolve();
    void even_out();

private:
    std::vector<std::uint32_t> sizes() const
    {
        std::vector<std::uint32_t> size(a_.count, 0);
        for (const std::uint32_t c : a_.members)
        {
            ++size[a_.colour[c]];
        }
        return size;
    }

    /// Marks the colours that the neighbours of a constraint have.
    void mark_neighbours(std::uint32_t c)
    {
        ++stamp_;
        for_each_moving(a_.graph, c, [&](std::uint32_t v) {
            for (const std::uint32_t other : a_.at_vertex.of(v))
            {
                if (other != c)
                {
                    blocker_stamp_[a_.colour[other]] = stamp_;
                }
            }
        });
    }
    bool blocked(std::uint32_t colour) const { return blocker_stamp_[colour] == stamp_; }

    std::uint32_t free_colour(std::uint32_t c, std::uint32_t limit, std::uint32_t except);
    bool clear_colour(std::uint32_t c, std::uint32_t colour, std::uint32_t limit);
    bool place(std::uint32_t c, std::uint32_t limit);
    void smallest_last();

    Assignment& a_;
    std::vector<std::uint32_t> blocker_stamp_; ///< by colour
    std::uint32_t stamp_ = 0;
    std::size_t budget_ = 0;
};

/// The lowest colour below the limit that no neighbour has, kNone if there is none.
std::uint32_t Balancer::free_colour(std::uint32_t c, std::uint32_t limit, std::uint32_t except)
{
    mark_neighbours(c);
    for (std::uint32_t k = 0; k < limit; ++k)
    {
        if (k != except && !blocked(k))
        {
            return k;
        }
    }
    return kNone;
}

/// Moves the neighbours of c that have a colour to others. False, with nothing changed, if one cannot.
bool Balancer::clear_colour(std::uint32_t c, std::uint32_t colour, std::uint32_t limit)
{
    std::vector<std::uint32_t> blockers;
    for_each_moving(a_.graph, c, [&](std::uint32_t v) {
        for (const std::uint32_t other : a_.at_vertex.of(v))
        {
            if (other != c && a_.colour[other] == colour)
            {
                blockers.push_back(other);
            }
        }
    });
    std::sort(blockers.begin(), blockers.end());
    blockers.erase(std::unique(blockers.begin(), blockers.end()), blockers.end());
    for (std::size_t i = 0; i < blockers.size(); ++i)
    {
        const std::uint32_t k = free_colour(blockers[i], limit, colour);
        if (k == kNone)
        {
            for (std::size_t j = 0; j < i; ++j)
            {
                a_.colour[blockers[j]] = colour;
            }
            return false;
        }
        a_.colour[blockers[i]] = k;
    }
    return true;
}

/// Gives c a colour below the limit, if need be by moving its neighbours.
bool Balancer::place(std::uint32_t c, std::uint32_t limit)
{
    const std::uint32_t k = free_colour(c, limit, kNone);
    if (k != kNone)
    {
        a_.colour[c] = k;
        return true;
    }
    for (std::uint32_t colour = 0; colour < limit; ++colour)
    {
        if (clear_colour(c, colour, limit))
        {
            a_.colour[c] = colour;
            return true;
        }
    }
    return a_.graph.stride == 2 && budget_ > 0 && exchange_colours(a_, c, limit, budget_);
}

void Balancer::smallest_last()
{
    const std::vector<std::uint32_t> size = sizes();
    const auto from_last = std::min_element(size.rbegin(), size.rend()) - size.rbegin();
    const std::uint32_t last = a_.count - 1, chosen = last - static_cast<std::uint32_t>(from_last);
    for (const std::uint32_t c : a_.members)
    {
        std::uint32_t& colour = a_.colour[c];
        colour = colour == chosen ? last : colour == last ? chosen : colour;
    }
}

/// Removes small colours while that works. No colouring has fewer colours than the degree.
void Balancer::dissolve()
{
    for (const std::uint32_t degree = a_.degree(); a_.count > degree;)
    {
        smallest_last();
        const std::uint32_t last = a_.count - 1;
        std::vector<std::uint32_t> tail;
        std::copy_if(a_.members.begin(), a_.members.end(), std::back_inserter(tail),
                     [&](std::uint32_t c) { return a_.colour[c] == last; });
        if (2 * tail.size() * a_.count > a_.members.size() ||
            !std::all_of(tail.begin(), tail.end(), [&](std::uint32_t c) { return place(c, last); }))
        {
            return;
        }
        a_.count = last;
    }
}

/// Moves members of colours above the mean size to the smallest feasible colour below it.
void Balancer::even_out()
{
    std::vector<std::uint32_t> size = sizes();
    const auto mean = static_cast<std::uint32_t>((a_.members.size() + a_.count - 1) / a_.count);
    std::set<std::pair<std::uint32_t, std::uint32_t>> small; // size, colour
    for (std::uint32_t k = 0; k < a_.count; ++k)
    {
        if (size[k] < mean)
        {
            small.insert({size[k], k});
        }
    }
    for (const std::uint32_t c : a_.members)
    {
        if (size[a_.colour[c]] <= mean || small.empty())
        {
            continue;
        }
        mark_neighbours(c);
        const auto is_free = [&](const auto& entry) { return !blocked(entry.second); };
        const auto to = std::find_if(small.begin(), small.end(), is_free);
        if (to == small.end())
        {
            continue;
        }
        const std::uint32_t k = to->second;
        small.erase(to);
        --size[a_.colour[c]];
        a_.colour[c] = k;
        if (++size[k] < mean)
        {
            small.insert({size[k], k});
        }
    }
}

} // namespace

void balance(Assignment& assignment)
{
    if (assignment.count < 2)
    {
        return;
    }
    Balancer balancer(assignment);
    balancer.dissolve();
    balancer.even_out();
}

} // namespace taut::colouring
