// Based on: Welsh, Powell. An upper bound for the chromatic number of a graph. 1967 (greedy);
//   Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024 (colours of vertices).
// Departures: vertices of a grid try the lattices (x + p y) mod m first: 5 colours for structural, shear and
//   bend springs, where greedy may take more; those of generated boxes of tetrahedra have four.
#include "taut/plan/vertex_colouring.hpp"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

namespace taut {
namespace {

/// Lowest colour that no neighbour has. `taken` is scratch, marked with the vertex' number + 1.
std::uint32_t lowest_free(const VertexGraph& graph, const std::vector<std::uint32_t>& colour, std::uint32_t v,
                          std::vector<std::uint32_t>& taken)
{
    for (const std::uint32_t other : graph.neighbours[v])
        if (colour[other] != kNoColour)
            taken[colour[other]] = v + 1;
    std::uint32_t c = 0;
    while (taken[c] == v + 1)
        ++c;
    return c;
}

VertexColours greedy(const VertexGraph& graph)
{
    VertexColours out;
    out.colour.assign(graph.vertex_count, kNoColour);
    std::vector<std::uint32_t> taken(graph.vertex_count + 1, 0);
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
        if (graph.free[v])
        {
            out.colour[v] = lowest_free(graph, out.colour, v, taken);
            out.count = std::max(out.count, out.colour[v] + 1);
        }
    return out;
}

/// The smallest class below `most` members that v may join, else its own.
std::uint32_t smaller_class(const VertexGraph& graph, const VertexColours& colours,
                            const std::vector<std::size_t>& size, std::uint32_t v, std::size_t most)
{
    std::vector<bool> taken(colours.count, false);
    for (const std::uint32_t other : graph.neighbours[v])
        taken[colours.colour[other]] = true;
    std::uint32_t best = colours.colour[v];
    for (std::uint32_t c = 0; c < colours.count; ++c)
        if (!taken[c] && size[c] < most && size[c] < size[best])
            best = c;
    return best;
}

void even_out(const VertexGraph& graph, VertexColours& colours)
{
    if (colours.count < 2)
        return;
    std::vector<std::size_t> size(colours.count, 0);
    std::size_t total = 0;
    for (const std::uint32_t c : colours.colour)
        if (c != kNoColour)
        {
            ++size[c];
            ++total;
        }
    const std::size_t mean = (total + colours.count - 1) / colours.count;
    for (int pass = 0; pass < 3; ++pass)
        for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
            if (graph.free[v] && size[colours.colour[v]] > mean)
            {
                const std::uint32_t to = smaller_class(graph, colours, size, v, mean);
                --size[colours.colour[v]];
                ++size[to];
                colours.colour[v] = to;
            }
}

/// Steps in the grid from a vertex to those it shares an element with.
std::set<std::pair<std::int64_t, std::int64_t>> grid_steps(const VertexGraph& graph, std::uint32_t columns)
{
    std::set<std::pair<std::int64_t, std::int64_t>> steps;
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
        for (const std::uint32_t other : graph.neighbours[v])
            if (other > v)
                steps.emplace(std::int64_t(other % columns) - std::int64_t(v % columns),
                              std::int64_t(other / columns) - std::int64_t(v / columns));
    return steps;
}

/// The lattice of fewest colours, at most `most`; count 0 if there is none.
VertexColours lattice(const VertexGraph& graph, std::uint32_t columns, std::uint32_t most)
{
    const auto steps = grid_steps(graph, columns);
    for (std::int64_t m = 1; m <= most; ++m)
        for (std::int64_t p = 0; p < m; ++p)
        {
            const bool valid = std::none_of(steps.begin(), steps.end(), [&](const auto& step) {
                return (step.first + p * step.second) % m == 0;
            });
            if (!valid)
                continue;
            VertexColours out;
            out.lattice = true;
            out.count = static_cast<std::uint32_t>(m);
            for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
                out.colour.push_back(graph.free[v]
                                         ? static_cast<std::uint32_t>((v % columns + p * (v / columns)) % m)
                                         : kNoColour);
            return out;
        }
    return {};
}

} // namespace

VertexGraph::VertexGraph(std::vector<bool> moves)
    : vertex_count(static_cast<std::uint32_t>(moves.size())),
      neighbours(moves.size()),
      free(std::move(moves))
{}

void VertexGraph::add(std::span<const std::uint32_t> corners, std::uint32_t arity)
{
    for (std::size_t k = 0; k + arity <= corners.size(); k += arity)
        for (std::size_t i = k; i < k + arity; ++i)
            for (std::size_t j = k; j < k + arity; ++j)
                if (corners[i] != corners[j] && free[corners[i]] && free[corners[j]])
                    neighbours[corners[i]].push_back(corners[j]);
}

void VertexGraph::finish()
{
    for (std::vector<std::uint32_t>& list : neighbours)
    {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
}

VertexColours colour_vertices(const VertexGraph& graph, std::uint32_t columns)
{
    VertexColours found = greedy(graph);
    if (columns > 0)
    {
        VertexColours regular = lattice(graph, columns, found.count);
        if (regular.count > 0)
            return regular;
    }
    even_out(graph, found);
    return found;
}

namespace {

/// Of six tetrahedra a cell, edges go along (x, y, z) with entries of 0 and 1: 1 to 3 layers on.
std::uint32_t six_colour(const glm::uvec3& p) { return (p.x + p.y + p.z) % 4; }

/// Of five, vertices of even layers join across all faces: the parities of x and y differ. Those of odd
/// layers have six neighbours, of three colours.
std::uint32_t five_colour(const glm::uvec3& p)
{
    const std::uint32_t turn = (p.x + p.y + p.z) % 2;
    return 2 * ((p.x + turn) % 2) + (p.y + turn) % 2;
}

bool is_colouring(const VertexGraph& graph, const std::vector<std::uint32_t>& colour)
{
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
        for (const std::uint32_t other : graph.neighbours[v])
            if (colour[v] == colour[other])
                return false;
    return true;
}

} // namespace

VertexColours colour_box(const VertexGraph& graph, std::span<const glm::uvec3> places)
{
    assert(places.size() == graph.vertex_count);
    VertexColours found = greedy(graph);
    for (const auto of : {six_colour, five_colour})
    {
        VertexColours regular;
        regular.count = 4;
        regular.lattice = true;
        for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
            regular.colour.push_back(graph.free[v] ? of(places[v]) : kNoColour);
        if (found.count >= regular.count && is_colouring(graph, regular.colour))
            return regular;
    }
    even_out(graph, found);
    return found;
}

} // namespace taut
