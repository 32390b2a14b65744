// Groups of elements by halving.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 6.2.1 (top-down: cut the longest side in half).
// Departures: one level only, the leaves: a look goes over all of their bounds.

#include "taut/report/element_groups.hpp"
#include "taut/report/is_finite.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace taut {
namespace {

constexpr std::size_t kMost = 48; ///< elements in a group

glm::dvec3 centre_of(const ElementCorners& e, std::span<const glm::dvec3> rest, std::uint32_t first)
{
    return (rest[e[0] - first] + rest[e[1] - first] + rest[e[2] - first]) / 3.0;
}

int longest_side(std::span<const glm::dvec3> points, std::span<const std::size_t> of)
{
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const std::size_t k : of)
    {
        low = glm::min(low, points[k]);
        high = glm::max(high, points[k]);
    }
    const glm::dvec3 side = high - low;
    const int xy = side.x >= side.y ? 0 : 1;
    return side[xy] >= side.z ? xy : 2;
}

/// Sorts `order`, the part from `begin` of all elements, so that groups of neighbours are runs of it.
void halve(std::span<const glm::dvec3> points, std::span<std::size_t> order, std::size_t begin,
           std::vector<ElementGroup>& out)
{
    if (order.size() <= kMost)
        return out.push_back({begin, order.size()});
    const int side = longest_side(points, order);
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::size_t a, std::size_t b) {
                         const double pa = points[a][side], pb = points[b][side];
                         return pa != pb ? pa < pb : a < b;
                     });
    halve(points, order.first(half), begin, out);
    halve(points, order.subspan(half), begin + half, out);
}

} // namespace

double GroupMotion::radius() const { return 0.5 * glm::length(high - low); }

ElementGroups::ElementGroups(const std::vector<ElementCorners>& elements, std::span<const glm::dvec3> rest,
                             std::uint32_t first)
{
    std::vector<glm::dvec3> centres;
    for (const ElementCorners& e : elements)
        centres.push_back(centre_of(e, rest, first));
    std::vector<std::size_t> order(elements.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (!elements.empty())
        halve(centres, order, 0, groups_);
    for (const std::size_t k : order)
        elements_.push_back(elements[k]);
    collect_vertices(rest.size(), first);
}

void ElementGroups::collect_vertices(std::size_t count, std::uint32_t first)
{
    std::vector<bool> used(count, false);
    const auto begin_of = [&](const ElementGroup& group) {
        return vertices_.begin() + static_cast<std::ptrdiff_t>(group.first_vertex);
    };
    for (ElementGroup& group : groups_)
    {
        group.first_vertex = vertices_.size();
        for (const ElementCorners& e : elements(group))
            vertices_.insert(vertices_.end(), e.begin(), e.end());
        std::sort(begin_of(group), vertices_.end());
        vertices_.erase(std::unique(begin_of(group), vertices_.end()), vertices_.end());
        group.vertices = vertices_.size() - group.first_vertex;
        for (const std::uint32_t v : vertices(group))
            used[v - first] = true;
    }
    ElementGroup rest{elements_.size(), 0, vertices_.size(), 0};
    for (std::size_t v = 0; v < count; ++v)
        if (!used[v])
            vertices_.push_back(first + static_cast<std::uint32_t>(v));
    rest.vertices = vertices_.size() - rest.first_vertex;
    if (rest.vertices > 0)
        groups_.push_back(rest);
}

GroupMotion ElementGroups::motion(const ElementGroup& group, const SceneMotion& now) const
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    GroupMotion out{glm::dvec3(infinite), glm::dvec3(-infinite)};
    double speed = 0, way = 0; // squares
    for (const std::uint32_t i : vertices(group))
    {
        const glm::dvec3 &x = now.x[i], &v = now.v[i];
        out.low = glm::min(out.low, x);
        out.high = glm::max(out.high, x);
        out.finite = out.finite && is_finite(x);
        speed = std::max(speed, glm::dot(v, v)); // of what is not finite nothing
        if (!now.last.empty())
            way = std::max(way, glm::dot(x - now.last[i], x - now.last[i]));
    }
    out.speed = std::sqrt(speed);
    out.way = std::sqrt(way);
    return out;
}

} // namespace taut
