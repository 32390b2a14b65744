// Based on: Ericson 2004, "Real-Time Collision Detection", ch. 5.1, for the points that can be nearest.
// Departures: each candidate is measured and the smallest distance wins, so no sign has to be classified.

#include "taut/judge/distance.hpp"

#include "taut/judge/box_tree.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::judging {
namespace {

/// How far along the segment ab the point nearest to p lies, 0..1.
double along_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 e = b - a;
    const double size = glm::dot(e, e);
    return size > 0 ? std::clamp(glm::dot(p - a, e) / size, 0.0, 1.0) : 0.0;
}

/// Keeps the nearest pair, and the square of its distance for the tree.
struct Search
{
    const Surface& surface;
    const std::vector<glm::dvec3>& positions;
    bool between_parts;
    Nearest best;
    double squared = std::numeric_limits<double>::infinity();

    bool allowed(std::uint32_t a, std::uint32_t b) const
    {
        return !between_parts || surface.part[a] != surface.part[b];
    }
    void offer(double distance, bool edges, std::uint32_t a, std::uint32_t b)
    {
        if (distance * distance >= squared)
            return;
        squared = distance * distance;
        best = {distance, edges, a, b};
    }
    void vertices();
    void edges();
};

void Search::vertices()
{
    std::vector<Box> boxes(surface.triangles.size());
    std::vector<bool> used(surface.vertices, false);
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const std::uint32_t v : surface.triangles[t])
        {
            boxes[t].add(positions[v]);
            used[v] = true;
        }
    const BoxTree tree(boxes);
    for (std::uint32_t v = 0; v < surface.vertices; ++v)
    {
        Box box;
        box.add(positions[v]);
        if (used[v])
            tree.near(box, squared, [&](std::uint32_t t) {
                const Triangle& c = surface.triangles[t];
                if (!has(c, v) && allowed(v, c[0]) && surface.judged(std::array{v}, c))
                    offer(
                        nearest_of_triangle(positions[v], {positions[c[0]], positions[c[1]], positions[c[2]]})
                            .distance,
                        false, v, t);
            });
    }
}

void Search::edges()
{
    std::vector<Box> boxes(surface.edges.size());
    for (std::size_t e = 0; e < boxes.size(); ++e)
        for (const std::uint32_t v : surface.edges[e])
            boxes[e].add(positions[v]);
    const BoxTree tree(boxes);
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    {
        const std::uint32_t a = surface.edges[e][0], b = surface.edges[e][1];
        tree.near(boxes[e], squared, [&](std::uint32_t other) {
            const auto [c, d] = surface.edges[other];
            if (other <= e || a == c || a == d || b == c || b == d || !allowed(a, c) ||
                !surface.judged(surface.edges[e], surface.edges[other]))
                return;
            offer(nearest_of_segments(positions[a], positions[b], positions[c], positions[d]).distance, true,
                  e, other);
        });
    }
}

} // namespace

NearestOfTriangle nearest_of_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t)
{
    NearestOfTriangle nearest{std::numeric_limits<double>::infinity(), {}};
    for (int k = 0; k < 3; ++k)
    {
        const int next = (k + 1) % 3;
        const double along = along_segment(p, t[k], t[next]);
        const double distance = glm::length(p - t[k] - along * (t[next] - t[k]));
        if (distance >= nearest.distance)
            continue;
        nearest = {distance, glm::dvec3(0)};
        nearest.shares[k] = 1 - along;
        nearest.shares[next] = along;
    }
    const glm::dvec3 e0 = t[1] - t[0], e1 = t[2] - t[0], q = p - t[0], n = glm::cross(e0, e1);
    const double size = glm::dot(n, n);
    if (!(size > 0))
        return nearest;
    const double v = glm::dot(glm::cross(q, e1), n) / size, w = glm::dot(glm::cross(e0, q), n) / size;
    const double distance = std::abs(glm::dot(q, n)) / std::sqrt(size);
    if (v >= 0 && w >= 0 && v + w <= 1 && distance < nearest.distance)
        nearest = {distance, {1 - v - w, v, w}};
    return nearest;
}

NearestOfSegments nearest_of_segments(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& q0,
                                      const glm::dvec3& q1)
{
    const glm::dvec3 r0 = p1 - p0, r1 = q1 - q0, q = p0 - q0, n = glm::cross(r0, r1);
    NearestOfSegments nearest{std::numeric_limits<double>::infinity(), 0, 0};
    const auto offer = [&](double s, double t) {
        const double distance = glm::length(q + s * r0 - t * r1);
        if (distance < nearest.distance)
            nearest = {distance, s, t};
    };
    offer(0, along_segment(p0, q0, q1));
    offer(1, along_segment(p1, q0, q1));
    offer(along_segment(q0, p0, p1), 0);
    offer(along_segment(q1, p0, p1), 1);
    const double size = glm::dot(n, n);
    if (!(size > 0))
        return nearest;
    const double s = glm::dot(n, glm::cross(r1, q)) / size, t = glm::dot(n, glm::cross(r0, q)) / size;
    const double distance = std::abs(glm::dot(q, n)) / std::sqrt(size);
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1 && distance < nearest.distance)
        nearest = {distance, s, t};
    return nearest;
}

Nearest nearest_pair(const Surface& surface, const std::vector<glm::dvec3>& positions, bool between_parts)
{
    Search search{surface, positions, between_parts, {}};
    if (between_parts && surface.parts < 2)
        return search.best;
    search.vertices();
    search.edges();
    return search.best;
}

} // namespace taut::judging
