#pragma once
// Distances of surfaces in fp64, and whether two triangles intersect: plain host code that shares nothing
// with kernels/contact.
//
// Based on: Ericson. Real-Time Collision Detection. 2004, 5.1.5 (regions of a triangle), 5.1.9 (segments),
//   5.3.4 (lines through triangles).

#include "taut/scene/scene.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace taut::test {

using glm::dvec3;

/// Weights of the four corners, and what they add up to: from the second to the first.
struct Nearest
{
    std::array<double, 4> weight{};
    dvec3 way{0};
    double distance() const { return glm::length(way); }
};

inline Nearest nearest_in_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c)
{
    const auto at = [&](double u, double v, double w) {
        return Nearest{{1, -u, -v, -w}, p - (a * u + b * v + c * w)};
    };
    const dvec3 ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d1 <= 0 && d2 <= 0)
        return at(1, 0, 0);
    if (d3 >= 0 && d4 <= d3)
        return at(0, 1, 0);
    if (d6 >= 0 && d5 <= d6)
        return at(0, 0, 1);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return at(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return at(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(0, 1 - w, w);
    }
    const double sum = va + vb + vc;
    return at(va / sum, vb / sum, vc / sum);
}

inline Nearest nearest_of_segments(const dvec3& p0, const dvec3& p1, const dvec3& q0, const dvec3& q1)
{
    const dvec3 d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
    const double a = glm::dot(d1, d1), e = glm::dot(d2, d2), b = glm::dot(d1, d2);
    const double c = glm::dot(d1, r), f = glm::dot(d2, r), over = a * e - b * b;
    double s = over > 0 ? glm::clamp((b * f - c * e) / over, 0.0, 1.0) : 0, t = (b * s + f) / e;
    if (t < 0 || t > 1)
    {
        t = glm::clamp(t, 0.0, 1.0);
        s = glm::clamp((b * t - c) / a, 0.0, 1.0);
    }
    return {{1 - s, s, t - 1, -t}, (p0 + d1 * s) - (q0 + d2 * t)};
}

/// Six times the volume of a tetrahedron, 0 where that is no more than rounding.
inline double volume_of(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d)
{
    const dvec3 ab = b - a, ac = c - a, ad = d - a;
    const double volume = glm::dot(glm::cross(ab, ac), ad);
    return std::abs(volume) > 1e-13 * glm::length(ab) * glm::length(ac) * glm::length(ad) ? volume : 0;
}

/// Whether the segment p-q passes through the triangle, its border included; one in its plane does not.
inline bool pierces(const dvec3& p, const dvec3& q, const dvec3& a, const dvec3& b, const dvec3& c)
{
    if (!(volume_of(a, b, c, p) * volume_of(a, b, c, q) < 0))
        return false;
    const double u = volume_of(p, q, a, b), v = volume_of(p, q, b, c), w = volume_of(p, q, c, a);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// All triangles of a resolved scene, in scene-wide vertices.
inline std::vector<std::array<std::uint32_t, 3>> all_triangles(const Scene& scene)
{
    std::vector<std::array<std::uint32_t, 3>> out;
    std::uint32_t first = 0;
    for (const Body& body : scene.bodies)
    {
        for (const auto& [a, b, c] : body.mesh.triangles)
            out.push_back({first + a, first + b, first + c});
        first += static_cast<std::uint32_t>(body.mesh.positions.size());
    }
    return out;
}

/// Pairs of triangles without a common vertex that intersect: every one against every other.
inline std::size_t intersections(const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 std::span<const dvec3> x)
{
    struct Box
    {
        dvec3 low, high;
    };
    std::vector<Box> boxes;
    for (const auto& [a, b, c] : triangles)
        boxes.push_back({glm::min(glm::min(x[a], x[b]), x[c]), glm::max(glm::max(x[a], x[b]), x[c])});
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t j = i + 1; j < triangles.size(); ++j)
        {
            const auto &t = triangles[i], &u = triangles[j];
            const bool apart = glm::any(glm::greaterThan(boxes[i].low, boxes[j].high)) ||
                               glm::any(glm::greaterThan(boxes[j].low, boxes[i].high));
            if (apart || std::find_first_of(t.begin(), t.end(), u.begin(), u.end()) != t.end())
                continue;
            bool meet = false;
            for (std::size_t k = 0; k < 3; ++k)
                meet = meet || pierces(x[t[k]], x[t[(k + 1) % 3]], x[u[0]], x[u[1]], x[u[2]]) ||
                       pierces(x[u[k]], x[u[(k + 1) % 3]], x[t[0]], x[t[1]], x[t[2]]);
            count += meet ? 1 : 0;
        }
    return count;
}

} // namespace taut::test
