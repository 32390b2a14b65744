// Patches of a tree of triangles that are height fields while they face one way.
//
// Based on: Volino, Magnenat-Thalmann. Efficient self-collision detection on smoothly discretized surface
//   animations using geometrical shape regularity. Computer Graphics Forum 13(3), 1994; Andrew. Another
//   efficient algorithm for convex hulls in two dimensions. Information Processing Letters 9(5), 1979.
// Departures: their test of the outline at run time is made once, at rest: what is nearly convex there and
//   keeps its sides and angles by its material stays without overlap while it faces one way.

#include "taut/plan/contact_patch.hpp"

#include "taut/kernels/shared/contact_rows.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace taut {
namespace {

constexpr std::uint32_t kHighest = 12; ///< levels above the leaves: 4,096 triangles
constexpr std::uint32_t kNone = ~0u;
constexpr double kWidest = 200; ///< degrees at a vertex of the border
constexpr double kFacing = 0.5; ///< of a normal along the mean, at rest
constexpr double kFilled = 0.6; ///< of the convex hull
constexpr double kOnce = 1 + 1e-6;

/// What a surface is by its sides.
struct Sides
{
    std::vector<std::array<std::uint32_t, 3>> beside; ///< leaf across the side from each corner to the next
    std::vector<bool> unfit; ///< of leaves with a corner or side that no patch may have
};

double angle_at(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 u = b - a, v = c - a;
    return glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
}

Sides sides_of(std::span<const ContactLeaf> leaves, std::span<const glm::dvec3> rest)
{
    struct Side
    {
        std::uint32_t low, high, leaf, k;
    };
    std::vector<Side> all;
    std::vector<double> angle(rest.size(), 0);
    for (std::uint32_t i = 0; i < leaves.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const auto& corner = leaves[i].corner;
            const auto [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
            all.push_back({low, high, i, k});
            angle[corner[k]] +=
                angle_at(rest[corner[k]], rest[corner[(k + 1) % 3]], rest[corner[(k + 2) % 3]]);
        }
    std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.leaf) < std::tie(b.low, b.high, b.leaf);
    });
    Sides out{std::vector(leaves.size(), std::array{kNone, kNone, kNone}), std::vector<bool>(leaves.size())};
    std::vector<std::uint32_t> borders(rest.size(), 0);
    std::vector<bool> bad(rest.size(), false);
    for (std::size_t first = 0, last = 0; first < all.size(); first = last)
    {
        while (last < all.size() && all[last].low == all[first].low && all[last].high == all[first].high)
            ++last;
        const Side &one = all[first], &other = all[last - 1];
        if (last - first == 2)
        {
            out.beside[one.leaf][one.k] = other.leaf;
            out.beside[other.leaf][other.k] = one.leaf;
        }
        for (const std::uint32_t v : {one.low, one.high})
        {
            borders[v] += last - first == 1;
            bad[v] = bad[v] || last - first > 2;
        }
    }
    for (std::size_t v = 0; v < rest.size(); ++v)
        bad[v] = bad[v] || borders[v] > 2 || (borders[v] > 0 && angle[v] > kWidest);
    for (std::size_t i = 0; i < leaves.size(); ++i)
        for (const std::uint32_t v : leaves[i].corner)
            out.unfit[i] = out.unfit[i] || bad[v];
    return out;
}

/// Leaves from `first` to before `last`.
struct Range
{
    std::uint32_t first, last;
    bool has(std::uint32_t leaf) const { return leaf != kNone && leaf >= first && leaf < last; }
    std::uint32_t size() const { return last - first; }
};

bool hangs_together(const Sides& sides, const Range& range)
{
    std::vector<bool> seen(range.size(), false);
    std::vector<std::uint32_t> next{range.first};
    seen[0] = true;
    std::uint32_t count = 0;
    while (!next.empty())
    {
        const std::uint32_t leaf = next.back();
        next.pop_back();
        ++count;
        for (const std::uint32_t other : sides.beside[leaf])
            if (range.has(other) && !seen[other - range.first])
            {
                seen[other - range.first] = true;
                next.push_back(other);
            }
    }
    return count == range.size();
}

double cross_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double hull_area(std::vector<glm::dvec2> points)
{
    const auto before = [](const glm::dvec2& a, const glm::dvec2& b) {
        return std::pair(a.x, a.y) < std::pair(b.x, b.y);
    };
    std::sort(points.begin(), points.end(), before);
    double area = 0;
    for (int side = 0; side < 2; ++side)
    {
        std::vector<glm::dvec2> chain;
        for (const glm::dvec2& p : points)
        {
            while (chain.size() > 1 && cross_of(chain[chain.size() - 2], chain.back(), p) <= 0)
                chain.pop_back();
            chain.push_back(p);
        }
        for (std::size_t k = 0; k + 1 < chain.size(); ++k)
            area += 0.5 * (chain[k].x * chain[k + 1].y - chain[k].y * chain[k + 1].x);
        std::reverse(points.begin(), points.end());
    }
    return area;
}

glm::dvec3 normal_of(const ContactLeaf& leaf, std::span<const glm::dvec3> x)
{
    const glm::dvec3& a = x[leaf.corner[0]];
    return glm::cross(x[leaf.corner[1]] - a, x[leaf.corner[2]] - a);
}

/// Whether a range, seen along the mean of its normals, lies open before the eye: every part once.
bool lies_open(std::span<const ContactLeaf> leaves, const Sides& sides, const Range& range,
               std::span<const glm::dvec3> rest)
{
    glm::dvec3 sum(0);
    for (std::uint32_t i = range.first; i < range.last; ++i)
        sum += normal_of(leaves[i], rest);
    if (!(glm::length(sum) > 0))
        return false;
    const glm::dvec3 n = glm::normalize(sum);
    const glm::dvec3 u =
        glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 v = glm::cross(n, u);
    double area = 0;
    std::vector<glm::dvec2> border;
    for (std::uint32_t i = range.first; i < range.last; ++i)
    {
        const glm::dvec3 normal = normal_of(leaves[i], rest);
        if (!(glm::dot(normal, n) >= kFacing * glm::length(normal)))
            return false;
        area += 0.5 * glm::dot(normal, n);
        for (std::size_t k = 0; k < 3; ++k)
            if (!range.has(sides.beside[i][k]))
                for (const std::size_t c : {k, (k + 1) % 3})
                    border.emplace_back(glm::dot(rest[leaves[i].corner[c]], u),
                                        glm::dot(rest[leaves[i].corner[c]], v));
    }
    const double hull = hull_area(std::move(border));
    return area >= kFilled * hull && area <= kOnce * hull;
}

bool is_patch(std::span<const ContactLeaf> leaves, const Sides& sides, const Range& range,
              std::span<const glm::dvec3> rest)
{
    for (std::uint32_t i = range.first; i < range.last; ++i)
        if (leaves[i].body != leaves[range.first].body || sides.unfit[i])
            return false;
    return hangs_together(sides, range) && lies_open(leaves, sides, range, rest);
}

} // namespace

void mark_patches(std::span<ContactLeaf> leaves, std::span<const glm::dvec3> rest)
{
    const auto count = static_cast<std::uint32_t>(leaves.size());
    const Sides sides = sides_of(leaves, rest);
    std::vector<bool> marked(leaves.size(), true); // of the level below
    for (std::uint32_t level = TAUT_CONTACT_PATCH; level <= kHighest && count >> level > 0; ++level)
        for (std::uint32_t first = 0; first < count; first += 1u << level)
        {
            const Range range{first, std::min(count, first + (1u << level))};
            const auto its = [&](std::uint32_t leaf) { return static_cast<std::ptrdiff_t>(leaf); };
            const auto begin = marked.begin() + its(range.first), end = marked.begin() + its(range.last);
            const bool patch = std::find(begin, end, false) == end && is_patch(leaves, sides, range, rest);
            std::fill(begin, end, patch);
            for (std::uint32_t i = range.first; i < range.last && patch; ++i)
                leaves[i].owns = (leaves[i].owns & ((1u << TAUT_CONTACT_OWNS_PATCH) - 1)) |
                                 (level << TAUT_CONTACT_OWNS_PATCH);
        }
}

} // namespace taut
