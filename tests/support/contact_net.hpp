#pragma once
// What the tests of contact kernels share: triangles that lie about each other in strips, as leaves of a
// tree.

#include "support/expect.hpp"
#include "support/nearest.hpp"
#include "support/random.hpp"

#include "taut/kernels/shared/contact_rows.h"

#include <array>
#include <set>

namespace taut::conformance {

template <typename Real>
struct ContactNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<layout::ContactTriangle<Real>> triangle;
    std::vector<layout::ContactBody<Real>> body;
    std::vector<Vec> position, delta;
    std::uint32_t leaves = 1;

    glm::dvec3 x(std::uint32_t v) const { return glm::dvec3(position[v]); }
    glm::dvec3 d(std::uint32_t v) const { return glm::dvec3(delta[v]); }
};

/// Every vertex and side to the first triangle that has it; leaves for all triangles.
template <typename Real>
void share_out(ContactNet<Real>& net)
{
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (auto& t : net.triangle)
    {
        const std::uint32_t corner[] = {t.a, t.b, t.c};
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const auto side = std::minmax(corner[k], corner[(k + 1) % 3]);
            t.owns |= vertices.insert(corner[k]).second ? 1u << k : 0;
            t.owns |= sides.insert({side.first, side.second}).second ? 1u << (3 + k) : 0;
        }
    }
    while (net.leaves < net.triangle.size())
        net.leaves *= 2;
}

/// Strips of ten triangles of sides of some 0.1 m, each strip of the next of three bodies, of which the
/// second does not meet itself. All meet each other.
template <typename Real>
ContactNet<Real> contact_net(std::uint32_t triangles, Random& random, double motion)
{
    ContactNet<Real> net;
    net.body = {{Real(0.01), Real(0.2), 1, 1, ~0u, 1},
                {Real(0.02), Real(0.6), 0, 2, ~0u, 2},
                {Real(0.015), Real(0), 1, 4, ~0u, 0}};
    const double room = 0.12 * std::cbrt(static_cast<double>(triangles));
    glm::dvec3 at(0);
    for (std::uint32_t t = 0; t < triangles; ++t)
    {
        const bool begins = t % 10 == 0;
        if (begins)
            at = glm::dvec3(random.uniform(-room, room), random.uniform(-room, room),
                            random.uniform(-room, room));
        for (int k = 0; k < (begins ? 3 : 1); ++k)
        {
            at += 0.07 * glm::dvec3(random.vec4<double>(1, 0));
            net.position.emplace_back(glm::vec<3, Real>(at), random.inverse_mass<Real>());
            net.delta.push_back(random.vec4<Real>(motion, Real(0)));
        }
        const auto last = static_cast<std::uint32_t>(net.position.size() - 1);
        net.triangle.push_back({last - 2, last - 1, last, t / 10 % 3, 0});
    }
    share_out(net);
    return net;
}

/// Pairs of corners that the net's kernels act on: vertices against triangles, and edges, four corners each.
template <typename Real>
std::vector<layout::ContactPair<Real>> some_pairs(const ContactNet<Real>& net, std::uint32_t count,
                                                  Random& random)
{
    std::vector<layout::ContactPair<Real>> pairs;
    while (pairs.size() < count)
    {
        const auto& t = net.triangle[random.below(static_cast<std::uint32_t>(net.triangle.size()))];
        const auto& u = net.triangle[random.below(static_cast<std::uint32_t>(net.triangle.size()))];
        const std::set<std::uint32_t> all = {t.a, t.b, t.c, u.a, u.b, u.c};
        if (all.size() == 6 && random.chance(0.5))
            pairs.push_back({t.a, u.a, u.b, u.c, TAUT_CONTACT_VERTEX});
        else if (all.size() == 6)
            pairs.push_back({t.a, t.b, u.b, u.c, TAUT_CONTACT_EDGES});
    }
    return pairs;
}

/// In fp64, at places that `x` gives.
template <typename Real, typename Place>
test::Nearest nearest_of(const layout::ContactPair<Real>& p, Place x)
{
    return p.kind == TAUT_CONTACT_EDGES ? test::nearest_of_segments(x(p.a), x(p.b), x(p.c), x(p.d))
                                        : test::nearest_in_triangle(x(p.a), x(p.b), x(p.c), x(p.d));
}

/// Whether every weight is this far from 0 and 1: within the triangle, or within both edges.
inline bool is_inside(const test::Nearest& n, double margin, bool edges)
{
    double least = 1;
    for (std::size_t k = edges ? 0 : 1; k < 4; ++k)
        least = std::min({least, std::abs(n.weight[k]), edges ? 1 - std::abs(n.weight[k]) : 1.0});
    return least > margin;
}

inline std::vector<std::uint32_t> words_of(const Buffers& out, const char* name)
{
    return values_of<std::uint32_t>(out.at(name));
}

/// A control buffer that lists so many pairs.
inline std::vector<std::uint32_t> control_of(std::uint32_t listed)
{
    std::vector<std::uint32_t> control(TAUT_CONTACT_WORDS, 0);
    control[TAUT_CONTACT_LISTED] = listed;
    return control;
}

/// Corners of pairs at each vertex, as contact_sort leaves them.
struct CornerLists
{
    std::vector<std::uint32_t> start{0}, corner;

    template <typename Real>
    CornerLists(const std::vector<layout::ContactPair<Real>>& pairs, std::size_t vertices)
    {
        std::vector<std::vector<std::uint32_t>> at(vertices);
        for (std::uint32_t k = 0; k < pairs.size(); ++k)
        {
            const std::uint32_t ids[] = {pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d};
            for (std::uint32_t j = 0; j < 4; ++j)
                at[ids[j]].push_back(4 * k + j);
        }
        for (const auto& row : at)
        {
            corner.insert(corner.end(), row.begin(), row.end());
            start.push_back(static_cast<std::uint32_t>(corner.size()));
        }
    }
};

/// Some pairs of a net, none twice.
template <typename Real>
std::vector<layout::ContactPair<Real>> unlike_pairs(const ContactNet<Real>& net, std::uint32_t count,
                                                    Random& random)
{
    auto pairs = some_pairs(net, count, random);
    std::set<std::array<std::uint32_t, 4>> listed;
    std::erase_if(pairs, [&](const auto& p) { return !listed.insert({p.a, p.b, p.c, p.d}).second; });
    return pairs;
}

} // namespace taut::conformance
