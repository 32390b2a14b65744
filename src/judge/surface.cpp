#include "taut/judge/surface.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace taut::judging {
namespace {

void find_edges(Surface& s)
{
    std::map<Edge, std::vector<std::uint32_t>> found;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
        {
            const std::uint32_t a = s.triangles[t][k], b = s.triangles[t][(k + 1) % 3];
            if (a != b)
                found[{std::min(a, b), std::max(a, b)}].push_back(t);
        }
    for (auto& [edge, triangles] : found)
    {
        s.edges.push_back(edge);
        s.edge_triangles.push_back(std::move(triangles));
    }
}

void find_parts(Surface& s)
{
    std::vector<std::uint32_t> parent(s.vertices);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Edge& e : s.edges)
    {
        const std::uint32_t a = root(e[0]), b = root(e[1]);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<bool> used(s.vertices, false); // vertices inside a solid are on no triangle
    for (const Edge& e : s.edges)
        used[e[0]] = used[e[1]] = true;
    s.part.assign(s.vertices, Surface::kNoPart);
    for (std::uint32_t v = 0; v < s.vertices; ++v)
        if (used[v])
            s.part[v] = root(v) == v ? static_cast<std::uint32_t>(s.parts++) : s.part[root(v)];
}

/// Whether triangle t runs from a to b.
bool runs(const Triangle& t, std::uint32_t a, std::uint32_t b)
{
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

void find_closed(Surface& s)
{
    std::vector<bool> open(s.parts, false), used(s.parts, false);
    for (std::size_t e = 0; e < s.edges.size(); ++e)
    {
        const auto& around = s.edge_triangles[e];
        const std::uint32_t a = s.edges[e][0], b = s.edges[e][1];
        const bool sound =
            around.size() == 2 && runs(s.triangles[around[0]], a, b) != runs(s.triangles[around[1]], a, b);
        used[s.part[a]] = true;
        if (!sound)
            open[s.part[a]] = true;
    }
    for (std::uint32_t p = 0; p < s.parts; ++p)
        if (used[p] && !open[p])
            s.closed.push_back(p);
}

void find_borders(Surface& s)
{
    constexpr std::uint32_t kNone = 0xffffffffu, kMany = 0xfffffffeu;
    std::vector<std::uint32_t> next(s.vertices, kNone);
    for (std::size_t e = 0; e < s.edges.size(); ++e)
    {
        if (s.edge_triangles[e].size() != 1)
            continue;
        auto [a, b] = s.edges[e];
        if (!runs(s.triangles[s.edge_triangles[e][0]], a, b))
            std::swap(a, b);
        next[a] = next[a] == kNone ? b : kMany;
    }
    std::vector<bool> done(s.vertices, false);
    for (std::uint32_t v = 0; v < s.vertices; ++v)
    {
        std::vector<std::uint32_t> loop;
        std::uint32_t at = v;
        while (next[at] < kMany && !done[at])
        {
            done[at] = true;
            loop.push_back(at);
            at = next[at];
        }
        if (loop.size() > 2 && at == v)
            s.borders.push_back(std::move(loop));
    }
}

} // namespace

Surface make_surface(std::size_t vertices, std::vector<Triangle> triangles, std::vector<bool> led,
                     PassingBodies passing)
{
    Surface s;
    s.vertices = vertices;
    s.triangles = std::move(triangles);
    s.led = std::move(led);
    s.passing = std::move(passing);
    find_edges(s);
    find_parts(s);
    find_closed(s);
    find_borders(s);
    return s;
}

} // namespace taut::judging
