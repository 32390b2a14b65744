#include "taut/world/start_ways.hpp"

#include "taut/world/start_shapes.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// |cos| of an edge and a normal, below which the edge is taken to lie in the plane.
constexpr double kSteepest = 1e-6;
/// Of a sum of unit vectors: what is shorter is rounding.
constexpr double kCancelled = 1e-9;

glm::dvec3 unit(const glm::dvec3& v)
{
    const double size = glm::length(v);
    return size > 0 ? v / size : glm::dvec3(0);
}

} // namespace

StartWays::StartWays(const StartSurfaces& surfaces, const std::vector<glm::dvec3>& places,
                     std::span<const judging::CrossingEdge> crossed)
    : surfaces_(surfaces),
      surface_(surfaces.surface()),
      x_(places),
      size_(places.size())
{
    Joined joined(places.size());
    std::size_t next = 0;
    for (std::uint32_t e = 0; e < surface_.edges.size(); ++e)
    {
        while (next < crossed.size() && crossed[next].edge < e)
            ++next;
        if (next == crossed.size() || crossed[next].edge != e)
            joined.join(surface_.edges[e][0], surface_.edges[e][1]);
    }
    piece_of_ = joined.roots();
    for (const std::uint32_t piece : piece_of_)
        ++size_[piece];
}

std::optional<std::uint32_t> StartWays::cut_off(const judging::CrossingEdge& c) const
{
    const std::uint32_t a = piece_of_[surface_.edges[c.edge][0]], b = piece_of_[surface_.edges[c.edge][1]];
    if (a == b)
        return std::nullopt;
    if (size_[a] == size_[b]) // of two halves the same one for every edge between them
        return std::min(a, b);
    return size_[a] < size_[b] ? a : b;
}

glm::dvec3 StartWays::way(const judging::CrossingEdge& c) const { return cut_off(c) ? back(c) : shorter(c); }

glm::dvec3 StartWays::normal_of(std::uint32_t triangle) const
{
    const judging::Triangle& t = surface_.triangles[triangle];
    return unit(glm::cross(x_[t[1]] - x_[t[0]], x_[t[2]] - x_[t[0]]));
}

/// Two in one plane leave it, all edges of the first one way and all of the second the other: the normal with
/// its largest coordinate positive, for the body, or of one body the vertex, of the lower number.
glm::dvec3 StartWays::out_of_plane(const judging::CrossingEdge& c) const
{
    glm::dvec3 n = normal_of(c.triangle);
    const glm::dvec3 size = glm::abs(n);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (n[axis] < 0)
        n = -n;
    const std::uint32_t v = surface_.edges[c.edge][0], w = surface_.triangles[c.triangle][0];
    const std::uint32_t a = surfaces_.body_of(v), b = surfaces_.body_of(w);
    return (a != b ? a < b : v < w) ? n : -n;
}

/// G = sum over the triangles j at the edge of R_j - 2 (E . R_j) / (E . N) N, with R_j the direction in which
/// the two triangles cross, into j, E that of the edge and N the normal of the triangle.
glm::dvec3 StartWays::shorter(const judging::CrossingEdge& c) const
{
    const auto [a, b] = surface_.edges[c.edge];
    const glm::dvec3 along = unit(x_[b] - x_[a]), n = normal_of(c.triangle);
    const double slope = glm::dot(along, n);
    glm::dvec3 out(0);
    for (const std::uint32_t t : surface_.edge_triangles[c.edge])
    {
        const judging::Triangle& own = surface_.triangles[t];
        std::uint32_t third = a;
        for (const std::uint32_t v : own)
            if (v != a && v != b)
                third = v;
        const glm::dvec3 inwards = x_[third] - x_[a];
        glm::dvec3 r = unit(glm::cross(n, normal_of(t)));
        if (glm::dot(r, inwards - glm::dot(inwards, along) * along) < 0)
            r = -r;
        out += r;
        if (std::abs(slope) > kSteepest)
            out -= 2 * glm::dot(along, r) / slope * n;
    }
    return glm::length(out) > kCancelled ? unit(out) : out_of_plane(c); // a straight curve has no shorter one
}

/// From the smaller piece to the larger one, through the triangle.
glm::dvec3 StartWays::back(const judging::CrossingEdge& c) const
{
    const auto [a, b] = surface_.edges[c.edge];
    const glm::dvec3 along = unit(cut_off(c) == piece_of_[a] ? x_[b] - x_[a] : x_[a] - x_[b]);
    const glm::dvec3 normal = normal_of(c.triangle);
    const double height = glm::dot(normal, along);
    if (!(std::abs(height) > kSteepest))
        return out_of_plane(c);
    return height < 0 ? -normal : normal;
}

} // namespace taut
