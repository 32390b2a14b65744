// Based on: Baerentzen, Aanaes. Signed distance computation using the angle weighted pseudonormal. IEEE TVCG
//   2005: the sign is that of the way from the nearest point along the normal of the feature on which it
//   lies.
// Departures: none.

#include "taut/judge/mesh_distance.hpp"

#include "taut/judge/distance.hpp"
#include "taut/runtime/base/in_parallel.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace taut::judging {
namespace {

std::vector<Box> boxes_of(std::span<const std::array<std::uint32_t, 3>> triangles,
                          std::span<const glm::dvec3> positions)
{
    std::vector<Box> boxes(triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const std::uint32_t v : triangles[t])
            boxes[t].add(positions[v]);
    return boxes;
}

/// rad, between two edges that leave a corner.
double angle(const glm::dvec3& u, const glm::dvec3& v)
{
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

glm::dvec3 unit(const glm::dvec3& v)
{
    const double size = glm::length(v);
    return size > 0 ? v / size : glm::dvec3(0);
}

} // namespace

MeshDistance::MeshDistance(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const glm::dvec3> positions)
    : triangles_(triangles),
      positions_(positions),
      of_face_(triangles.size()),
      of_corner_(positions.size()),
      of_edge_(triangles.size()),
      tree_(boxes_of(triangles, positions))
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, glm::dvec3> edges;
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
        const auto& v = triangles[t];
        of_face_[t] = unit(glm::cross(positions[v[1]] - positions[v[0]], positions[v[2]] - positions[v[0]]));
        for (std::size_t k = 0; k < 3; ++k)
        {
            const std::uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
            of_corner_[a] += angle(positions[b] - positions[a], positions[c] - positions[a]) * of_face_[t];
            edges[std::minmax(a, b)] += of_face_[t];
        }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            of_edge_[t][k] = edges.at(std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]));
}

glm::dvec3 MeshDistance::way_out(std::uint32_t t, const glm::dvec3& shares) const
{
    const auto& v = triangles_[t];
    for (int k = 0; k < 3; ++k)
        if (shares[(k + 1) % 3] <= 0 && shares[(k + 2) % 3] <= 0)
            return of_corner_[v[static_cast<std::size_t>(k)]];
    for (int k = 0; k < 3; ++k)
        if (shares[(k + 2) % 3] <= 0)
            return of_edge_[t][static_cast<std::size_t>(k)];
    return of_face_[t];
}

double MeshDistance::at(const glm::dvec3& p) const
{
    Box place;
    place.add(p);
    double bound = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    NearestOfTriangle found;
    tree_.near(place, bound, [&](std::uint32_t t) {
        const auto& v = triangles_[t];
        const NearestOfTriangle now =
            nearest_of_triangle(p, {positions_[v[0]], positions_[v[1]], positions_[v[2]]});
        if (now.distance * now.distance < bound)
        {
            bound = now.distance * now.distance;
            found = now;
            nearest = t;
        }
    });
    const auto& v = triangles_[nearest];
    const glm::dvec3 foot = found.shares.x * positions_[v[0]] + found.shares.y * positions_[v[1]] +
                            found.shares.z * positions_[v[2]];
    return std::copysign(found.distance, glm::dot(p - foot, way_out(nearest, found.shares)));
}

DistanceField make_distance_field(const MeshDistance& surface, std::span<const glm::dvec3> positions,
                                  double cell, double margin)
{
    Box box;
    for (const glm::dvec3& p : positions)
        box.add(p);
    DistanceField out;
    out.cell = cell;
    const glm::dvec3 size = box.high - box.low + 2 * margin;
    for (int axis = 0; axis < 3; ++axis)
        out.points[static_cast<std::size_t>(axis)] =
            static_cast<std::uint32_t>(std::ceil(size[axis] / cell)) + 1;
    out.low = 0.5 * (box.low + box.high) - out.half_size();
    out.values.resize(std::size_t(out.points[0]) * out.points[1] * out.points[2]);
    in_parallel(out.points[2], [&](std::uint32_t k) {
        for (std::size_t j = 0; j < out.points[1]; ++j)
            for (std::size_t i = 0; i < out.points[0]; ++i)
                out.values[out.index(i, j, k)] = static_cast<float>(surface.at(out.place(i, j, k)));
    });
    return out;
}

} // namespace taut::judging
