#pragma once
// Closed surfaces with their tables, as the effect surface_volume lays them out: what the tests of
// kernels/volume share.

#include "support/expect.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>

namespace taut::conformance {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A tetrahedron of which triangles at random are split in three until there are `vertices` (4 or more); a
/// closed surface whose triangles look outwards, its vertices numbered from `first`.
inline Triangles split_surface(Random& random, std::uint32_t first, std::uint32_t vertices)
{
    Triangles out = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    for (std::uint32_t v = 4; v < vertices; ++v)
    {
        const std::uint32_t k = random.below(static_cast<std::uint32_t>(out.size()));
        const auto [a, b, c] = out[k];
        out[k] = {a, b, v};
        out.push_back({b, c, v});
        out.push_back({c, a, v});
    }
    for (auto& t : out)
        for (std::uint32_t& v : t)
            v += first;
    return out;
}

template <typename Real>
struct SurfaceNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<Vec> position, low, delta;
    std::vector<Triangles> triangles;        ///< a surface
    std::vector<std::uint32_t> groups, list; ///< 6 words a group, 2 a vertex: the kernels' table
    std::vector<std::uint32_t> corner;
    std::vector<Real> surface; ///< rest volume, compliance

    std::uint32_t group_count() const { return static_cast<std::uint32_t>(groups.size() / 6); }
    std::uint32_t listed() const { return static_cast<std::uint32_t>(list.size() / 2); }
    std::vector<std::uint32_t> table() const
    {
        std::vector<std::uint32_t> out = groups;
        out.insert(out.end(), list.begin(), list.end());
        out.push_back(0);
        out.push_back(static_cast<std::uint32_t>(corner.size() / 2));
        return out;
    }
};

/// Adds a surface of `count` vertices at random places, in groups of `chunk`, and a vertex of no surface.
template <typename Real>
void add_surface(SurfaceNet<Real>& net, Random& random, std::uint32_t count, std::uint32_t chunk)
{
    static constexpr double kCompliances[] = {0, 1e-9, 1e-4, 1e38};
    const auto first = static_cast<std::uint32_t>(net.position.size()), begin = net.listed();
    for (std::uint32_t v = 0; v <= count; ++v)
    {
        const Real w = random.inverse_mass<Real>();
        net.position.push_back(random.vec4<Real>(1, w));
        net.low.push_back(random.vec4<Real>(1e-8, random.uniform<Real>(0, 1e-3)));
        net.delta.push_back(random.vec4<Real>(1e-2, net.low.back().w));
    }
    const Triangles triangles = split_surface(random, first, count);
    for (std::uint32_t v = first; v < first + count; ++v)
    {
        net.list.push_back(v);
        net.list.push_back(static_cast<std::uint32_t>(net.corner.size() / 2));
        for (const auto& t : triangles)
            for (std::size_t k = 0; k < 3; ++k)
                if (t[k] == v)
                {
                    net.corner.push_back(t[(k + 1) % 3]);
                    net.corner.push_back(t[(k + 2) % 3]);
                }
    }
    const std::uint32_t from = net.group_count(), shares = (count + chunk - 1) / chunk;
    const auto number = static_cast<std::uint32_t>(net.triangles.size());
    for (std::uint32_t v = 0; v < count; v += chunk)
        for (const std::uint32_t word :
             {begin + v, begin + std::min(v + chunk, count), first, number, from, shares})
            net.groups.push_back(word);
    net.triangles.push_back(triangles);
    net.surface.push_back(random.uniform<Real>(-1, 1));
    net.surface.push_back(static_cast<Real>(kCompliances[random.below(4)]));
}

/// Surfaces of the sizes given, and behind them one of a single point and one with every vertex held.
template <typename Real>
SurfaceNet<Real> surface_net(Random& random, const std::vector<std::uint32_t>& counts, std::uint32_t chunk)
{
    SurfaceNet<Real> net;
    for (const std::uint32_t count : counts)
        add_surface(net, random, count, chunk);
    const std::size_t point = net.position.size();
    add_surface(net, random, 5, chunk);
    const std::size_t held = net.position.size();
    add_surface(net, random, 6, chunk);
    for (std::size_t v = point; v < net.position.size(); ++v)
    {
        const Real w = v < held ? Real(1) : Real(0);
        net.position[v] = v < held ? glm::vec<4, Real>(1, 2, 3, w) : net.position[v];
        net.position[v].w = w;
        net.low[v] = net.delta[v] = glm::vec<4, Real>(0);
    }
    return net;
}

} // namespace taut::conformance
