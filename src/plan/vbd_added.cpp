// Elements that the program has added, under vertex block descent: their part of every block before the
// vertices of a colour take their step, and of the sums that guard where sweeps begin and end.
//
// Based on: kernels/methods/vbd/vbd.comp, vbd_element_rise.comp.
// Departures: none.

#include "taut/plan/vbd_rows.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr std::uint32_t kCounts = 0x80000000u; ///< of an entry: this vertex counts the element

/// Two words a row, {vertex, first entry}, and behind them the entries; rows in the order of `colours`.
std::vector<std::uint32_t> row_table(const BlockBuffers& f, const AddedSet& set, const Incidence& at,
                                     const std::vector<std::vector<std::uint32_t>>& colours)
{
    const std::uint32_t corners = set.kind->corners;
    std::vector<std::uint32_t> table, entries;
    const std::uint32_t begin = 2 * (f.rows + 1);
    const auto mark = [&](std::uint32_t vertex) {
        table.insert(table.end(), {vertex, begin + static_cast<std::uint32_t>(entries.size())});
    };
    std::vector<bool> counted(set.count(), false);
    for (const auto& colour : colours)
        for (const std::uint32_t v : colour)
        {
            mark(v);
            if (at.start[v + 1] - at.start[v] > kMaxLoopTrips)
                throw Error(ErrorCode::limit, std::to_string(at.start[v + 1] - at.start[v]) + " elements \"" +
                                                  set.kind->name + "\" meet at one vertex, at most " +
                                                  std::to_string(kMaxLoopTrips) + " fit one invocation");
            for (std::uint32_t k = at.start[v]; k < at.start[v + 1]; ++k)
            {
                const std::uint32_t element = at.entries[k] / corners;
                entries.push_back(at.entries[k] | (counted[element] ? 0u : kCounts));
                counted[element] = true;
            }
        }
    mark(0); // the end of the last row's
    table.insert(table.end(), entries.begin(), entries.end());
    return table;
}

/// Where each group's elements begin: a body's are dealt evenly to its groups.
std::vector<std::uint32_t> part_table(const PlanBuilder& b, const BlockBuffers& f, const AddedSet& set)
{
    std::vector<std::uint32_t> table;
    std::uint32_t first = 0;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        std::uint32_t end = first;
        while (end < set.count() &&
               set.vertices[std::size_t{end} * set.kind->corners] < b.plan.body_start[body + 1])
            ++end;
        const std::uint32_t groups = f.group_start[body + 1] - f.group_start[body];
        for (std::uint32_t g = 0; g < groups; ++g)
            table.push_back(first + static_cast<std::uint32_t>(std::uint64_t{end - first} * g / groups));
        first = end;
    }
    table.push_back(first);
    return table;
}

} // namespace

void prepare_vbd_added(PlanBuilder& b, BlockBuffers& f, const BlockElements& elements,
                       const std::vector<std::vector<std::uint32_t>>& colours)
{
    if (elements.added.empty())
        return;
    f.block = b.add_buffer("vbd_solve", "blocks of added elements",
                           std::uint64_t(b.plan.vertex_count) * 4 *
                               (f.touched == kNoBuffer ? 3 : 3 + TAUT_VBD_CONTACT) * b.real_size());
    for (std::size_t k = 0; k < elements.added.size(); ++k)
    {
        const AddedSet& set = elements.added[k];
        const std::string& name = set.kind->name;
        BlockBuffers::Kind kind;
        kind.name = name;
        kind.corners = set.kind->corners;
        kind.count = set.count();
        kind.records = b.add_buffer<std::byte>(name, name + " constraints", set.records);
        kind.rows = b.add_buffer<std::uint32_t>(name, name + " at a vertex",
                                                row_table(f, set, elements.at_added[k], colours));
        if (f.sums != kNoBuffer)
            kind.parts = b.add_buffer<std::uint32_t>(name, name + " of a group", part_table(b, f, set));
        f.kinds.push_back(std::move(kind));
    }
}

void record_vbd_added(PlanBuilder& b, const BlockBuffers::Run& run, bool report)
{
    const BlockBuffers& f = *b.blocks;
    std::uint32_t begins = 1;
    for (const BlockBuffers::Kind& kind : f.kinds)
    {
        const std::uint32_t each = kind.count * kind.corners / std::max(f.rows, 1u) + 1;
        b.dispatch_by_name(kind.name, "vbd_" + kind.name,
                           {{"constraint", {kind.records, each}},
                            {"position", {b.plan.position, each * kind.corners}},
                            {"predicted", {b.plan.predicted}},
                            {"delta", {b.plan.delta, each * kind.corners}},
                            {"table", {kind.rows, 2 + each}},
                            {"block", {f.block, 3}},
                            {"events", {b.plan.events, 0}}},
                           {run.first, run.rows, begins, report ? 1u : 0u}, run.rows);
        begins = 0;
    }
}

void record_vbd_added_rise(PlanBuilder& b)
{
    const BlockBuffers& f = *b.blocks;
    for (const BlockBuffers::Kind& kind : f.kinds)
        b.dispatch_by_name(kind.name, "vbd_element_rise_" + kind.name,
                           {{"constraint", {kind.records}},
                            {"position", {b.plan.position, kind.corners}},
                            {"low", {b.plan.low, kind.corners}},
                            {"delta", {b.plan.delta, kind.corners}},
                            {"table", {kind.parts}},
                            {"sums", {f.sums, 0}}},
                           {f.groups}, f.groups, kind.count);
}

} // namespace taut
