// Which constraints both parts of a cut plan solve.
//
// Based on: Demmel, Hoemmen, Mohiyuddin, Yelick. Avoiding Communication in Sparse Matrix Computations. IPDPS
//   2008, section 2: what is computed twice for the sake of fewer exchanges, found from the last step back.
// Departures: steps are colours of a Gauss-Seidel sweep, of which each reaches one constraint further.

#include "taut/plan/cut_halo.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace taut {
namespace {

using Sweep = std::vector<const Dispatch*>;

/// Buffers of an element a vertex that constraints bind.
std::set<std::uint32_t> read_at_corners(const Plan& whole)
{
    std::set<std::uint32_t> out;
    for (const Dispatch& pass : whole.passes)
        for (std::size_t slot = 0; over(pass) == Over::constraints && slot < pass.bindings.size(); ++slot)
            if (each(pass, slot) == Each::vertex)
                out.insert(pass.bindings[slot].buffer);
    return out;
}

void add_written(const Dispatch& pass, std::set<std::uint32_t>& written)
{
    for (std::size_t slot = 0; slot < pass.bindings.size(); ++slot)
        if (writes(pass.kernel->bindings[slot].access))
            written.insert(pass.bindings[slot].buffer);
}

std::vector<std::uint32_t> common(const std::set<std::uint32_t>& a, const std::set<std::uint32_t>& b)
{
    std::vector<std::uint32_t> out;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out;
}

bool begins_with(const Sweep& sweep, const Sweep& start)
{
    return start.size() <= sweep.size() &&
           std::equal(start.begin(), start.end(), sweep.begin(),
                      [](const Dispatch* a, const Dispatch* b) { return colour_of(*a) == colour_of(*b); });
}

/// The longest sweeps; every other is the beginning of one of them, so that it solves the same constraints.
std::vector<Sweep> longest_sweeps(const std::vector<Sweep>& sweeps)
{
    std::vector<Sweep> out;
    for (const Sweep& sweep : sweeps)
    {
        const auto same = std::find_if(out.begin(), out.end(), [&](const Sweep& known) {
            return begins_with(known, sweep) || begins_with(sweep, known);
        });
        if (same == out.end())
            out.push_back(sweep);
        else if (same->size() < sweep.size())
            *same = sweep;
    }
    return out;
}

/// Those with a corner in `reach`, which then has all of theirs.
std::vector<std::uint32_t> touching(const Plan& whole, const Dispatch& pass, std::vector<bool>& reach)
{
    std::vector<std::uint32_t> out;
    const std::uint32_t first = param(pass, "first");
    for (std::uint32_t k = first; k < first + param(pass, "count"); ++k)
    {
        const std::vector<std::uint32_t> corners = corners_of(whole, pass, k);
        if (std::none_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return reach[v]; }))
            continue;
        out.push_back(k);
        for (const std::uint32_t v : corners) // of a colour no two constraints share one
            reach[v] = true;
    }
    return out;
}

} // namespace

std::vector<std::uint32_t> corners_of(const Plan& whole, const Dispatch& pass, std::uint32_t constraint)
{
    const std::vector<std::byte>& records = whole.buffers[pass.bindings.front().buffer].initial;
    std::vector<std::uint32_t> corners(corner_count(pass));
    std::memcpy(corners.data(), records.data() + constraint * pass.kernel->bindings.front().stride,
                corners.size() * sizeof(std::uint32_t));
    return corners;
}

/// Constraints may go on without an exchange until something moved vertices one by one, which a part does not
/// do in its halo, or a colour comes again.
ExchangePoints exchange_points(const Plan& whole, Exchange exchange)
{
    ExchangePoints out;
    const std::set<std::uint32_t> needed = read_at_corners(whole);
    std::set<std::uint32_t> written = needed;
    std::set<ColourKey> solved;
    bool due = true;
    for (std::size_t p = 0; p < whole.passes.size(); ++p)
    {
        const Dispatch& pass = whole.passes[p];
        if (over(pass) != Over::constraints)
            due = true;
        else if (due || exchange == Exchange::colour || solved.contains(colour_of(pass)))
        {
            out.before.push_back(p);
            out.buffers.push_back(common(needed, written));
            out.sweeps.emplace_back();
            written.clear();
            solved.clear();
            due = false;
        }
        if (over(pass) == Over::constraints)
        {
            solved.insert(colour_of(pass));
            out.sweeps.back().push_back(&pass);
        }
        add_written(pass, written);
    }
    return out;
}

Selection select_constraints(const Plan& whole, const ExchangePoints& points, std::vector<bool>& reach)
{
    Selection out;
    const std::vector<bool> own = reach;
    for (const Sweep& sweep : longest_sweeps(points.sweeps))
    {
        std::vector<bool> needed = own;
        for (auto pass = sweep.rbegin(); pass != sweep.rend(); ++pass)
            if (!out.emplace(colour_of(**pass), touching(whole, **pass, needed)).second)
                throw std::logic_error("a colour belongs to two sweeps of a plan that is cut");
        for (std::size_t v = 0; v < reach.size(); ++v)
            reach[v] = reach[v] || needed[v];
    }
    return out;
}

} // namespace taut
