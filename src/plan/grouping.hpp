#pragma once
// Internal to src/plan: how constraints of many bodies are laid out and grouped into passes.

#include "taut/plan/builder.hpp"
#include "taut/plan/topology.hpp"

#include <algorithm>

namespace taut {

/// One body's records by colour.
template <typename Element>
using Colours = std::vector<std::vector<Element>>;

/// Records of all bodies: colours shared by the large ones, hubs, small bodies on their own.
template <typename Element>
struct Coloured
{
    Colours<Element> colours;
    std::vector<std::vector<Element>> hubs;
    std::vector<Colours<Element>> small;
};

template <typename Element>
Colours<Element> by_colour(const std::vector<Element>& elements, const Colouring& colouring)
{
    Colours<Element> out(colouring.colour_count());
    for (std::size_t c = 0; c < colouring.colour_count(); ++c)
    {
        out[c].reserve(colouring.colour_start[c + 1] - colouring.colour_start[c]);
        for (std::uint32_t k = colouring.colour_start[c]; k < colouring.colour_start[c + 1]; ++k)
            out[c].push_back(elements[colouring.order[k]]);
    }
    return out;
}

/// Whether one group does a body's sweep sooner than a dispatch a colour would, by the device's costs.
/// Only among many bodies: groups of different bodies run side by side, a lone one leaves the device idle.
template <typename Element>
bool pays_alone(const PlanBuilder& b, const Colours<Element>& colours)
{
    std::size_t count = 0, trips = 0;
    for (const auto& colour : colours)
    {
        count += colour.size();
        trips += colour.size() / kGroupSize + 2;
    }
    if (trips >= kMaxLoopTrips || b.options.small_bodies == PlanOptions::SmallBodies::never)
        return false;
    if (b.options.small_bodies == PlanOptions::SmallBodies::always)
        return true;
    const DeviceTraits& t = b.traits;
    const double side_by_side = std::max(t.lane_element_ns / t.element_ns, 1.0);
    const double bodies = static_cast<double>(b.scene.bodies.size());
    const double number = static_cast<double>(colours.size());
    const double group = number * t.group_barrier_ns + static_cast<double>(count) * t.lane_element_ns;
    const double grouped = t.dispatch_ns + group * std::max(bodies / side_by_side, 1.0);
    const double dispatched = number * t.dispatch_ns + bodies * static_cast<double>(count) * t.element_ns;
    return grouped < dispatched;
}

template <typename Element>
void add_body(const PlanBuilder& b, Coloured<Element>& out, const std::vector<Element>& elements,
              const Colouring& colouring)
{
    Colours<Element> own = by_colour(elements, colouring);
    if (elements.empty())
        return;
    if (colouring.hubs.empty() && pays_alone(b, own))
    {
        out.small.push_back(std::move(own));
        return;
    }
    out.colours.resize(std::max(out.colours.size(), own.size()));
    for (std::size_t c = 0; c < own.size(); ++c)
        if (out.colours[c].empty())
            out.colours[c] = std::move(own[c]);
        else
            out.colours[c].insert(out.colours[c].end(), own[c].begin(), own[c].end());
}

/// Puts the records into one list and says where what went. `table` gets the colours. Each part is freed once
/// it has been copied.
template <typename Element>
ConstraintSet lay_out(std::string_view kind, Coloured<Element> coloured, std::vector<Element>& flat,
                      std::vector<std::uint32_t>& table)
{
    ConstraintSet set;
    set.kind = std::string(kind);
    const auto append = [&](std::vector<Element>& part) {
        flat.insert(flat.end(), part.begin(), part.end());
        part = std::vector<Element>();
        return static_cast<std::uint32_t>(flat.size());
    };
    std::size_t count = 0;
    const auto add = [&](const std::vector<std::vector<Element>>& parts) {
        for (const auto& part : parts)
            count += part.size();
    };
    add(coloured.colours);
    add(coloured.hubs);
    for (const Colours<Element>& body : coloured.small)
        add(body);
    flat.reserve(count);
    set.colour_start.push_back(0);
    for (auto& colour : coloured.colours)
        if (!colour.empty())
            set.colour_start.push_back(append(colour));
    if (!coloured.hubs.empty())
        set.hub_start.push_back(static_cast<std::uint32_t>(flat.size()));
    for (auto& hub : coloured.hubs)
        set.hub_start.push_back(append(hub));
    table = set.colour_start;
    const auto before_small = static_cast<std::uint32_t>(flat.size());
    std::vector<std::uint32_t> ranges;
    for (Colours<Element>& body : coloured.small)
    {
        ranges.push_back(static_cast<std::uint32_t>(table.size()));
        ranges.push_back(static_cast<std::uint32_t>(table.size() + body.size()));
        table.push_back(static_cast<std::uint32_t>(flat.size()));
        for (auto& colour : body)
            table.push_back(append(colour));
        set.small_colours = std::max(set.small_colours, static_cast<std::uint32_t>(body.size()));
    }
    set.small_bodies = static_cast<std::uint32_t>(coloured.small.size());
    set.small_range = static_cast<std::uint32_t>(table.size());
    set.small_constraints = static_cast<std::uint32_t>(flat.size()) - before_small;
    table.insert(table.end(), ranges.begin(), ranges.end());
    set.count = static_cast<std::uint32_t>(flat.size());
    return set;
}

/// A pass of one sweep: a colour of its own, or a run of small ones in one group.
struct Run
{
    std::uint32_t begin = 0, end = 0; ///< colours
    bool grouped() const { return end - begin >= 2; }
};

/// Colours smaller than this gain nothing from more than one group: the device's cost of a dispatch
/// against that of a phase and of lanes that work alone.
inline std::uint32_t small_colour(const DeviceTraits& traits)
{
    const double gain = traits.dispatch_ns - traits.group_barrier_ns;
    const double loss = std::max(traits.lane_element_ns - traits.element_ns, 1e-3);
    return static_cast<std::uint32_t>(std::clamp(gain / loss, 0.0, 4096.0));
}

inline std::vector<Run> runs_of(const PlanBuilder& b, const ConstraintSet& set)
{
    const std::uint32_t limit = small_colour(b.traits);
    const auto size = [&](std::uint32_t c) { return set.colour_start[c + 1] - set.colour_start[c]; };
    std::vector<Run> runs;
    for (std::uint32_t c = 0; c < set.colour_count();)
    {
        std::uint32_t end = c, trips = 0;
        while (end < set.colour_count() && size(end) <= limit &&
               trips + size(end) / kGroupSize + 2 < kMaxLoopTrips)
            trips += size(end++) / kGroupSize + 2;
        runs.push_back({c, std::max(end, c + 1)});
        c = runs.back().end;
    }
    return runs;
}

/// Before the dispatch of the small bodies, who would share the colours of the large ones.
inline void stand_for_small(PlanBuilder& b, const ConstraintSet& set)
{
    b.stands_for(std::max(set.small_colours, set.colour_count()) - set.colour_count());
}

/// Adds the device's table of colours, where groups that run several of them need one. `table`: as lay_out
/// leaves it.
inline void add_colour_table(PlanBuilder& b, ConstraintSet& set, std::vector<std::uint32_t> table)
{
    bool grouped = set.small_bodies > 0;
    for (const Run& run : runs_of(b, set))
        if (run.grouped())
        {
            table.insert(table.end(), {run.begin, run.end});
            grouped = true;
        }
    if (grouped)
        set.table = b.add_buffer<std::uint32_t>(set.kind, set.kind + " colours", table);
}

/// The ranges of grouped runs, two words each in order, after the small bodies' ones.
inline std::uint32_t first_run_range(const ConstraintSet& set)
{
    return set.small_range + 2 * set.small_bodies;
}

} // namespace taut
