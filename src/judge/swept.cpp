#include "taut/judge/swept.hpp"

#include "taut/judge/box_tree.hpp"
#include "taut/judge/distance.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace taut::judging {
namespace {

constexpr double kSlack = 1e-9;

using Four = std::array<glm::dvec3, 4>;

/// c0 + c1 t + c2 t^2 + c3 t^3: six times the volume of four points at time t.
struct Cubic
{
    double c0, c1, c2, c3;

    Cubic(const Four& x, const Four& way)
    {
        const glm::dvec3 u = x[1] - x[0], v = x[2] - x[0], w = x[3] - x[0];
        const glm::dvec3 du = way[1] - way[0], dv = way[2] - way[0], dw = way[3] - way[0];
        const glm::dvec3 uv = glm::cross(u, v), mixed = glm::cross(du, v) + glm::cross(u, dv);
        const glm::dvec3 ways = glm::cross(du, dv);
        c0 = glm::dot(uv, w);
        c1 = glm::dot(uv, dw) + glm::dot(mixed, w);
        c2 = glm::dot(mixed, dw) + glm::dot(ways, w);
        c3 = glm::dot(ways, dw);
    }

    double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }

    /// 0, the extrema between 0 and 1, and 1, in order: between two of them it only rises or only falls.
    std::vector<double> pieces() const
    {
        std::vector<double> ends{0};
        const double a = 3 * c3, b = 2 * c2, inside = b * b - 4 * a * c1;
        if (inside >= 0)
        {
            const double q = -0.5 * (b + std::copysign(std::sqrt(inside), b));
            for (const double t : {a != 0 ? q / a : -1, q != 0 ? c1 / q : -1})
                if (t > 0 && t < 1)
                    ends.push_back(t);
        }
        std::sort(ends.begin(), ends.end());
        ends.push_back(1);
        return ends;
    }

    /// The root between two ends where it only rises or only falls.
    std::optional<double> root(double low, double high) const
    {
        const double first = at(low), last = at(high);
        if ((first > 0) == (last > 0) && first != 0 && last != 0)
            return std::nullopt;
        if (first == 0 && last == 0)
            return std::nullopt; // in one plane all the way
        if (first == 0)
            return low;
        for (int i = 0; i < 60; ++i)
        {
            const double middle = (low + high) / 2;
            ((at(middle) > 0) == (first > 0) && at(middle) != 0 ? low : high) = middle;
        }
        return (low + high) / 2;
    }
};

Four moved(const Four& x, const Four& way, double t)
{
    Four out;
    for (std::size_t k = 0; k < 4; ++k)
        out[k] = x[k] + t * way[k];
    return out;
}

/// What counts as no distance: a share of all lengths at hand.
double slack_of(const Four& x, const Four& way)
{
    double size = 0;
    for (std::size_t k = 0; k < 4; ++k)
        size = std::max({size, glm::length(x[k] - x[0]), glm::length(way[k] - way[0])});
    return kSlack * size;
}

/// Corners 0 to 2 are a triangle.
double distance_of_vertex(const Four& x) { return distance_to_triangle(x[3], {x[0], x[1], x[2]}); }

/// Corners 0 and 1, and 2 and 3, are edges.
double distance_of_edges(const Four& x) { return distance_of_segments(x[0], x[1], x[2], x[3]); }

/// When the two features that four points make first meet.
std::optional<double> meeting_time(const Four& before, const Four& after, double (*distance)(const Four&))
{
    Four way;
    for (std::size_t k = 0; k < 4; ++k)
        way[k] = after[k] - before[k];
    const Cubic cubic(before, way);
    const double slack = slack_of(before, way);
    const std::vector<double> ends = cubic.pieces();
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        if (const auto t = cubic.root(ends[k], ends[k + 1]); t && distance(moved(before, way, *t)) <= slack)
            return t;
    return std::nullopt;
}

/// Both frames of one surface.
struct Ways
{
    const Surface& surface;
    const std::vector<glm::dvec3>&before, &after;

    template <typename Vertices>
    Box box(const Vertices& vertices) const
    {
        Box out;
        for (const std::uint32_t v : vertices)
        {
            out.add(before[v]);
            out.add(after[v]);
        }
        return out;
    }
    std::optional<double> meeting(const std::array<std::uint32_t, 4>& v,
                                  double (*distance)(const Four&)) const
    {
        return meeting_time({before[v[0]], before[v[1]], before[v[2]], before[v[3]]},
                            {after[v[0]], after[v[1]], after[v[2]], after[v[3]]}, distance);
    }
};

void add_vertices(const Ways& ways, std::vector<Passing>& out)
{
    const Surface& s = ways.surface;
    std::vector<Box> boxes;
    for (const Triangle& t : s.triangles)
        boxes.push_back(ways.box(t));
    const BoxTree tree(boxes);
    for (std::uint32_t v = 0; v < s.vertices; ++v)
        tree.overlapping(ways.box(std::array{v}), [&](std::uint32_t t) {
            const Triangle& c = s.triangles[t];
            if (has(c, v) || !s.judged(std::array{v}, c))
                return;
            if (const auto time = ways.meeting({c[0], c[1], c[2], v}, distance_of_vertex))
                out.push_back({false, v, t, *time});
        });
}

void add_edges(const Ways& ways, std::vector<Passing>& out)
{
    const Surface& s = ways.surface;
    std::vector<Box> boxes;
    for (const Edge& e : s.edges)
        boxes.push_back(ways.box(e));
    const BoxTree tree(boxes);
    for (std::uint32_t e = 0; e < s.edges.size(); ++e)
    {
        const std::uint32_t a = s.edges[e][0], b = s.edges[e][1];
        tree.overlapping(boxes[e], [&](std::uint32_t other) {
            const auto [c, d] = s.edges[other];
            if (other <= e || a == c || a == d || b == c || b == d || !s.judged(s.edges[e], s.edges[other]))
                return;
            if (const auto time = ways.meeting({a, b, c, d}, distance_of_edges))
                out.push_back({true, e, other, *time});
        });
    }
}

} // namespace

std::vector<Passing> passing_pairs(const Surface& surface, const std::vector<glm::dvec3>& before,
                                   const std::vector<glm::dvec3>& after)
{
    std::vector<Passing> out;
    const Ways ways{surface, before, after};
    add_vertices(ways, out);
    add_edges(ways, out);
    return out;
}

} // namespace taut::judging
