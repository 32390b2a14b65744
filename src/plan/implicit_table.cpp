#include "taut/plan/implicit_table.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

namespace taut {
namespace {

// As in kernels/shared/implicit_table.glsl.
constexpr std::uint32_t kFirst = 0x80000000u;
constexpr std::uint32_t kNowhere = 0xffffffffu;

void add_neighbours(std::vector<std::vector<std::uint32_t>>& of, const std::vector<bool>& solved,
                    const Corners& elements)
{
    for (std::size_t first = 0; first < elements.vertices.size(); first += elements.arity)
        for (std::uint32_t i = 0; i < elements.arity; ++i)
            for (std::uint32_t j = 0; j < elements.arity; ++j)
            {
                const std::uint32_t v = elements.vertices[first + i], other = elements.vertices[first + j];
                if (i != j && solved[v] && solved[other])
                    of[v].push_back(other);
            }
}

/// Looks blocks up and remembers which already hold something.
class Places
{
public:
    Places(const linear::SparseMatrix& pattern, std::span<const std::uint32_t> slots)
        : pattern_(pattern),
          slots_(slots),
          held_(pattern.column.size(), false)
    {}

    /// kNowhere if the block is not stored; marked the first time. A diagonal block is never the first's.
    std::uint32_t take(std::uint32_t row, std::uint32_t column)
    {
        const auto begin = pattern_.column.begin() + pattern_.row_start[3 * row];
        const auto end = pattern_.column.begin() + pattern_.row_start[3 * row + 1];
        const auto at = std::lower_bound(begin, end, 3 * column);
        if (at == end || *at != 3 * column)
            return kNowhere;
        const auto entry = static_cast<std::size_t>(at - pattern_.column.begin());
        const bool first = row != column && !held_[entry];
        held_[entry] = true;
        return slots_[entry] | (first ? kFirst : 0u);
    }

private:
    const linear::SparseMatrix& pattern_;
    std::span<const std::uint32_t> slots_;
    std::vector<bool> held_;
};

std::vector<std::uint32_t> table_of(const std::vector<bool>& solved, const Corners& elements, Places& places)
{
    const std::uint32_t arity = elements.arity, words = elements.words();
    const auto count = static_cast<std::uint32_t>(solved.size());
    std::vector<std::uint32_t> entries(count + 1, 0);
    for (const std::uint32_t v : elements.vertices)
        entries[v] += solved[v] ? 1 : 0;
    std::vector<std::uint32_t> table, next;
    std::uint32_t begin = 2 * (count + 1);
    for (std::uint32_t v = 0; v <= count; ++v)
    {
        next.push_back(begin);
        table.insert(table.end(), {begin, v < count && solved[v] ? places.take(v, v) : kNowhere});
        begin += words * entries[v];
    }
    table.resize(begin);
    for (std::uint32_t k = 0; k < elements.vertices.size() / arity; ++k)
    {
        const std::uint32_t* corner = &elements.vertices[std::size_t{k} * arity];
        std::uint32_t mark = kFirst;
        for (std::uint32_t c = 0; c < arity; ++c)
        {
            if (!solved[corner[c]])
                continue;
            std::uint32_t& at = next[corner[c]];
            table[at++] = (arity * k + c) | mark;
            mark = 0;
            for (std::uint32_t other = 0; other < arity; ++other)
                if (elements.own || other != c)
                    table[at++] = places.take(corner[c], corner[other]);
        }
    }
    return table;
}

} // namespace

std::vector<bool> solved_vertices(std::span<const double> inverse_mass, const AllCorners& elements)
{
    std::vector<bool> solved(inverse_mass.size(), false);
    for (const Corners& kind : elements)
        for (const std::uint32_t v : kind.vertices)
            solved[v] = inverse_mass[v] > 0;
    return solved;
}

linear::SparseMatrix implicit_pattern(const std::vector<bool>& solved, const AllCorners& elements,
                                      bool beside)
{
    const auto count = static_cast<std::uint32_t>(solved.size());
    std::vector<std::vector<std::uint32_t>> neighbours(count);
    if (beside)
        for (const Corners& kind : elements)
            add_neighbours(neighbours, solved, kind);
    linear::SparseMatrix out;
    out.rows = out.columns = 3 * count;
    for (std::uint32_t v = 0; v < count; ++v)
    {
        std::vector<std::uint32_t>& own = neighbours[v];
        own.push_back(v);
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        for (std::uint32_t i = 0; i < 3; ++i)
        {
            for (const std::uint32_t other : own)
                for (std::uint32_t j = 0; j < 3; ++j)
                {
                    out.column.push_back(3 * other + j);
                    out.value.push_back(other == v && i == j ? 1 : 0);
                }
            out.row_start.push_back(static_cast<std::uint32_t>(out.column.size()));
        }
        own = {};
    }
    return out;
}

std::vector<std::vector<std::uint32_t>> implicit_tables(const std::vector<bool>& solved,
                                                        const AllCorners& elements,
                                                        const linear::SparseMatrix& pattern,
                                                        std::span<const std::uint32_t> slots)
{
    Places places(pattern, slots);
    std::vector<std::vector<std::uint32_t>> out;
    for (const Corners& kind : elements)
        out.push_back(table_of(solved, kind, places));
    return out;
}

FreeParts free_parts(std::span<const double> inverse_mass, const AllCorners& elements)
{
    const auto count = static_cast<std::uint32_t>(inverse_mass.size());
    std::vector<std::uint32_t> root(count);
    for (std::uint32_t v = 0; v < count; ++v)
        root[v] = v;
    const auto find = [&](std::uint32_t v) {
        while (root[v] != v)
            v = root[v] = root[root[v]];
        return v;
    };
    std::vector<std::uint32_t> parts_at(count, 0); // vertices of the part of a root; 0: not to be listed
    for (const Corners& kind : elements)
        for (std::size_t k = 0; k < kind.vertices.size(); ++k)
        {
            const std::uint32_t one = find(kind.vertices[k - k % kind.arity]);
            const std::uint32_t other = find(kind.vertices[k]);
            root[std::max(one, other)] = std::min(one, other); // the first vertex of a part is its root
        }
    std::vector<bool> held(count, false);
    for (std::uint32_t v = 0; v < count; ++v)
    {
        ++parts_at[find(v)];
        held[find(v)] = held[find(v)] || !(inverse_mass[v] > 0);
    }
    FreeParts out;
    std::vector<std::uint32_t> next(count, 0);
    for (std::uint32_t v = 0; v < count; ++v)
        if (root[v] == v && !held[v] && parts_at[v] > 1)
        {
            next[v] = out.start.back();
            out.start.push_back(out.start.back() + parts_at[v]);
        }
    out.member.resize(out.start.back());
    for (std::uint32_t v = 0; v < count; ++v)
        if (const std::uint32_t r = find(v); !held[r] && parts_at[r] > 1)
            out.member[next[r]++] = v;
    return out;
}

std::uint64_t implicit_trips(std::span<const std::uint32_t> table, std::uint32_t vertices,
                             std::uint32_t words, std::uint32_t chunk)
{
    std::uint64_t most = 0;
    for (std::uint32_t first = 0; first < vertices; first += chunk)
    {
        std::uint64_t trips[TAUT_LINEAR_GROUP] = {};
        for (std::uint32_t v = first; v < std::min(vertices, first + chunk); ++v)
            trips[(v - first) % std::size(trips)] +=
                (table[2 * (v + 1)] - table[2 * v]) / words + 1;
        most = std::max(most, *std::max_element(std::begin(trips), std::end(trips)));
    }
    return most;
}

} // namespace taut
