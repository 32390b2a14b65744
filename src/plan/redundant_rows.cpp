// Based on: Maxwell. On the calculation of the equilibrium and stiffness of frames. 1864: bars against
//   3 n - 6 freedoms.
// Departures: counted in connected parts of what is left when vertices of three bars or fewer are taken away,
//   so that a stiff lump at the end of a chain is found.

#include "taut/plan/redundant_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace taut {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

Pair pair_of(const StretchElement& e) { return std::minmax(e.a, e.b); }

/// Marks springs over the same two vertices with lengths that differ by more than rounding.
void mark_contradictory(std::span<const StretchElement> springs, RedundantRows& out)
{
    std::map<Pair, std::pair<double, double>> lengths; // least and greatest
    for (const StretchElement& e : springs)
    {
        const auto [at, fresh] = lengths.try_emplace(pair_of(e), e.rest_length, e.rest_length);
        if (!fresh)
            at->second = {std::min(at->second.first, e.rest_length),
                          std::max(at->second.second, e.rest_length)};
    }
    for (std::size_t k = 0; k < springs.size(); ++k)
    {
        const auto& [least, most] = lengths.at(pair_of(springs[k]));
        if (most - least <= 1e-6 * most)
            continue;
        out.redundant[k] = true;
        out.contradictory[k] = true;
    }
}

/// The different springs as a graph whose vertices can be taken away.
class Frame
{
public:
    Frame(std::span<const StretchElement> springs, std::span<const double> inverse_mass)
        : inverse_mass_(inverse_mass)
    {
        std::set<Pair> pairs;
        for (const StretchElement& e : springs)
            if (pairs.insert(pair_of(e)).second)
            {
                near_[e.a].push_back(e.b);
                near_[e.b].push_back(e.a);
            }
    }

    /// Takes away what at most three springs hold.
    void peel()
    {
        std::vector<std::uint32_t> next;
        for (const auto& [v, others] : near_)
        {
            left_[v] = others.size();
            if (moves(v) && others.size() <= 3)
                next.push_back(v);
        }
        while (!next.empty())
        {
            const std::uint32_t v = next.back();
            next.pop_back();
            if (!gone_.insert(v).second)
                continue;
            for (const std::uint32_t other : near_.at(v))
                if (--left_.at(other) == 3 && moves(other) && gone_.count(other) == 0)
                    next.push_back(other);
        }
    }

    /// Vertices that move in parts with more springs than freedom, after peel().
    std::set<std::uint32_t> overfull() const
    {
        std::set<std::uint32_t> out, seen;
        for (const auto& entry : near_)
        {
            if (!stands(entry.first) || !seen.insert(entry.first).second)
                continue;
            std::vector<std::uint32_t> part = {entry.first};
            std::set<std::uint32_t> held;
            std::size_t ends = 0; // of springs within the part twice, to held vertices once
            std::size_t outside = 0;
            for (std::size_t k = 0; k < part.size(); ++k)
                for (const std::uint32_t other : near_.at(part[k]))
                {
                    if (!moves(other))
                    {
                        held.insert(other);
                        ++outside;
                    }
                    else if (stands(other))
                    {
                        ++ends;
                        if (seen.insert(other).second)
                            part.push_back(other);
                    }
                }
            constexpr std::size_t kLoose[] = {6, 3, 1, 0};
            if (ends / 2 + outside + kLoose[std::min<std::size_t>(held.size(), 3)] > 3 * part.size())
                out.insert(part.begin(), part.end());
        }
        return out;
    }

private:
    bool moves(std::uint32_t v) const { return inverse_mass_[v] > 0; }
    bool stands(std::uint32_t v) const { return moves(v) && gone_.count(v) == 0; }

    std::span<const double> inverse_mass_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> near_;
    std::map<std::uint32_t, std::size_t> left_;
    std::set<std::uint32_t> gone_;
};

} // namespace

RedundantRows redundant_rows(std::span<const StretchElement> springs, std::span<const double> inverse_mass)
{
    RedundantRows out;
    out.redundant.assign(springs.size(), false);
    out.contradictory.assign(springs.size(), false);
    mark_contradictory(springs, out);
    Frame frame(springs, inverse_mass);
    frame.peel();
    const std::set<std::uint32_t> overfull = frame.overfull();
    const auto within = [&](std::uint32_t v) { return !(inverse_mass[v] > 0) || overfull.count(v) == 1; };
    for (std::size_t k = 0; k < springs.size() && !overfull.empty(); ++k)
        if (within(springs[k].a) && within(springs[k].b))
            out.redundant[k] = true;
    return out;
}

} // namespace taut
