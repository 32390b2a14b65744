#include "taut/judge/judge.hpp"

#include "taut/judge/crossings.hpp"
#include "taut/judge/linking.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut::judging {
namespace {

constexpr double kMost = 1e30; ///< m; products of three coordinates stay finite

void check_positions(const std::vector<glm::dvec3>& positions)
{
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (int k = 0; k < 3; ++k)
            if (!(std::abs(positions[v][k]) <= kMost))
                throw Error(ErrorCode::bad_input,
                            "vertex " + std::to_string(v) +
                                " has a coordinate that is not finite or beyond 1e30 m");
}

void check_triangles(const std::vector<Triangle>& triangles, std::size_t vertices)
{
    if (triangles.empty())
        throw Error(ErrorCode::bad_input, "there is no triangle to judge");
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t v : triangles[t])
            if (v >= vertices)
                throw Error(ErrorCode::bad_input, "triangle " + std::to_string(t) + " names vertex " +
                                                      std::to_string(v) + "; there are " +
                                                      std::to_string(vertices) + ", numbered from 0");
}

double length(const Edge& edge, const std::vector<glm::dvec3>& positions)
{
    return glm::length(positions[edge[1]] - positions[edge[0]]);
}

std::vector<std::optional<int>> linking_of(const Surface& surface, const std::vector<glm::dvec3>& positions)
{
    std::vector<std::optional<int>> numbers;
    if (surface.borders.size() > Judge::kMostBorders)
        return numbers;
    // Bodies that pass through each other, or are led, may be linked now and not then.
    const auto judged = [&](std::size_t a, std::size_t b) {
        const std::uint32_t one = surface.borders[a].front(), other = surface.borders[b].front();
        return surface.judged(Edge{one, one}, Edge{other, other});
    };
    std::vector<std::vector<glm::dvec3>> curves;
    for (const auto& border : surface.borders)
    {
        curves.emplace_back();
        for (const std::uint32_t v : border)
            curves.back().push_back(positions[v]);
    }
    for (std::size_t a = 0; a < curves.size(); ++a)
        for (std::size_t b = a + 1; b < curves.size(); ++b)
            numbers.push_back(judged(a, b) ? linking_number(curves[a], curves[b]) : std::nullopt);
    return numbers;
}

} // namespace

Judge::Judge(std::vector<Triangle> triangles, const std::vector<glm::dvec3>& first, std::vector<bool> led,
             PassingBodies passing)
{
    check_positions(first);
    check_triangles(triangles, first.size());
    surface_ = make_surface(first.size(), std::move(triangles), std::move(led), std::move(passing));
    for (const Edge& edge : surface_.edges)
        lengths_.push_back(length(edge, first));
    for (const std::uint32_t part : surface_.closed)
        volumes_.push_back(volume(part, first));
}

/// By the divergence theorem, about a vertex of the part.
double Judge::volume(std::uint32_t part, const std::vector<glm::dvec3>& positions) const
{
    double six = 0;
    const glm::dvec3* origin = nullptr;
    for (const Triangle& t : surface_.triangles)
    {
        if (surface_.part[t[0]] != part)
            continue;
        origin = origin ? origin : &positions[t[0]];
        six += glm::dot(glm::cross(positions[t[0]] - *origin, positions[t[1]] - *origin),
                        positions[t[2]] - *origin);
    }
    return six / 6;
}

void Judge::check(const std::vector<glm::dvec3>& positions) const
{
    if (positions.size() != surface_.vertices)
        throw Error(ErrorCode::bad_input, "it has " + std::to_string(positions.size()) +
                                              " vertices; the first frame has " +
                                              std::to_string(surface_.vertices));
    check_positions(positions);
}

std::vector<Passing> Judge::between(const std::vector<glm::dvec3>& before,
                                    const std::vector<glm::dvec3>& after) const
{
    check(before);
    check(after);
    return passing_pairs(surface_, before, after);
}

FrameVerdict Judge::look(const std::vector<glm::dvec3>& positions) const
{
    check(positions);
    FrameVerdict out;
    out.first_pairs = intersecting_triangles(surface_, positions);
    out.intersecting = out.first_pairs.size();
    out.first_pairs.resize(std::min<std::size_t>(out.first_pairs.size(), 10));
    out.nearest = nearest_pair(surface_, positions, false);
    out.nearest_parts = nearest_pair(surface_, positions, true);
    for (std::uint32_t e = 0; e < surface_.edges.size(); ++e)
    {
        const bool judged = surface_.judged(surface_.edges[e], surface_.edges[e]);
        const double change =
            judged && lengths_[e] > 0 ? std::abs(length(surface_.edges[e], positions) / lengths_[e] - 1) : 0;
        if (change > out.stretch)
        {
            out.stretch = change;
            out.stretched_edge = e;
        }
    }
    for (std::size_t k = 0; k < volumes_.size(); ++k)
        if (volumes_[k] != 0)
            out.volume_change = std::max(out.volume_change,
                                         std::abs(volume(surface_.closed[k], positions) / volumes_[k] - 1));
    out.linking = linking_of(surface_, positions);
    return out;
}

} // namespace taut::judging
