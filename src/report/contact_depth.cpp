// Based on: Ericson. Real-Time Collision Detection. 2004, 5.1.5 and 5.1.9.
// Departures: none.

#include "taut/report/contact_depth.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

using glm::dvec3;

double from_segment(const dvec3& p, const dvec3& a, const dvec3& b)
{
    const dvec3 side = b - a;
    const double squared = glm::dot(side, side);
    const double t = squared > 0 ? glm::clamp(glm::dot(p - a, side) / squared, 0.0, 1.0) : 0;
    return glm::distance(p, a + side * t);
}

/// Whether the foot of p in the plane lies on the inner side of all three.
bool above(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& n)
{
    return glm::dot(glm::cross(b - a, p - a), n) >= 0 && glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
           glm::dot(glm::cross(a - c, p - c), n) >= 0;
}

double from_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c)
{
    const dvec3 n = glm::cross(b - a, c - a);
    const double size = glm::length(n);
    if (size > 0 && above(p, a, b, c, n))
        return std::abs(glm::dot(p - a, n)) / size;
    return std::min({from_segment(p, a, b), from_segment(p, b, c), from_segment(p, c, a)});
}

double between_segments(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d)
{
    const dvec3 p = b - a, q = d - c, n = glm::cross(p, q);
    const double squared = glm::dot(n, n);
    if (squared > 0)
    {
        const double s = glm::dot(glm::cross(c - a, q), n) / squared;
        const double t = glm::dot(glm::cross(c - a, p), n) / squared;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
            return std::abs(glm::dot(c - a, n)) / std::sqrt(squared);
    }
    return std::min(
        {from_segment(a, c, d), from_segment(b, c, d), from_segment(c, a, b), from_segment(d, a, b)});
}

} // namespace

double distance_of(const SurfacePair& pair, std::span<const dvec3> x)
{
    const auto& [a, b, c, d] = pair.vertex;
    return pair.edges ? between_segments(x[a], x[b], x[c], x[d]) : from_triangle(x[a], x[b], x[c], x[d]);
}

double contact_depth(const World& world, std::span<const dvec3> x)
{
    double depth = 0;
    for (const SurfacePair& pair : world.contact_pairs())
        depth = std::max(depth, pair.rest_gap - distance_of(pair, x));
    return depth;
}

std::vector<bool> in_contact(const World& world)
{
    std::vector<bool> out(world.plan().vertex_count, false);
    for (const SurfacePair& pair : world.contact_pairs())
        for (const std::uint32_t v : pair.vertex)
            out[v] = true;
    return out;
}

} // namespace taut
