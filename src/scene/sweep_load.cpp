// A body as a method that sweeps sees it: what hangs from one constraint, and how far from its pins.

#include "taut/scene/held.hpp"
#include "taut/scene/substeps.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const Body& body)
{
    Neighbours out(body.mesh.positions.size());
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        out[a].push_back(b);
        out[b].push_back(a);
    };
    for (const auto& t : body.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            add(t[k], t[(k + 1) % 3]);
    for (const auto& t : body.mesh.tetrahedra)
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t j = k + 1; j < 4; ++j)
                add(t[k], t[j]);
    for (const auto& link : body.mesh.links)
        add(link[0], link[1]);
    for (const Body::Spring& spring : body.springs)
        add(spring.a, spring.b);
    for (auto& list : out)
    {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return out;
}

/// Edges to the furthest vertex that `sources` reach, and that vertex.
std::pair<std::uint32_t, std::uint32_t> furthest(const Neighbours& around, std::vector<std::uint32_t> wave)
{
    std::vector<bool> seen(around.size(), false);
    for (const std::uint32_t v : wave)
        seen[v] = true;
    std::uint32_t depth = 0, last = wave.empty() ? 0 : wave.front();
    while (!wave.empty())
    {
        std::vector<std::uint32_t> next;
        last = wave.front();
        for (const std::uint32_t v : wave)
            for (const std::uint32_t u : around[v])
                if (!seen[u])
                {
                    seen[u] = true;
                    next.push_back(u);
                }
        if (!next.empty())
            ++depth;
        wave = std::move(next);
    }
    return {depth, last};
}

double mean_edge(const Body& body, const Neighbours& around)
{
    double sum = 0, count = 0;
    for (std::uint32_t v = 0; v < around.size(); ++v)
        for (const std::uint32_t u : around[v])
        {
            sum += glm::distance(body.mesh.positions[u], body.mesh.positions[v]);
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

/// Mass that moves over the mass of a vertex, for each edge from a pinned vertex to one that moves.
double hanging_vertices(const Body& body, const Neighbours& around, const std::vector<bool>& held)
{
    const auto mass = [&](std::uint32_t v) {
        return body.vertex_masses.empty() ? 1.0 : body.vertex_masses[v];
    };
    double total = 0, edges = 0, carriers = 0;
    for (std::uint32_t v = 0; v < around.size(); ++v)
    {
        if (held[v])
            continue;
        total += mass(v);
        for (const std::uint32_t u : around[v])
            if (held[u])
            {
                ++edges;
                carriers += mass(v);
            }
    }
    return edges > 0 ? total / carriers : 0;
}

} // namespace

SweepLoad sweep_load(const Body& body)
{
    const Neighbours around = neighbours_of(body);
    std::vector<std::uint32_t> pinned;
    for (const Pin& pin : body.pins)
        pinned.insert(pinned.end(), pin.vertices.begin(), pin.vertices.end());
    if (around.empty())
        return {};
    SweepLoad out;
    out.edge = mean_edge(body, around);
    const auto [reach, end] =
        furthest(around, pinned.empty() ? std::vector{furthest(around, {0}).second} : pinned);
    out.reach = reach;
    const auto apart = [&, last = end](std::uint32_t v) { // clang 14 takes no bindings along
        return glm::distance(body.mesh.positions[v], body.mesh.positions[last]);
    };
    const auto nearest = std::ranges::min_element(pinned, {}, apart);
    out.length = nearest == pinned.end() ? 0 : apart(*nearest);
    out.vertices = pinned.empty()
                       ? out.reach
                       : std::max<double>(out.reach, hanging_vertices(body, around, held_vertices(body)));
    return out;
}

} // namespace taut
