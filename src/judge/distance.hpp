#pragma once
// How near a surface comes to itself.

#include "taut/judge/surface.hpp"

#include <glm/vec3.hpp>

namespace taut::judging {

/// A pair of features without a common vertex and the distance between them in double precision (relative
/// error about 1e-15 of the coordinates).
struct Nearest
{
    double distance = -1; ///< m; -1: there is no such pair
    bool edges = false;   ///< two edges; else a vertex and a triangle
    std::uint32_t a = 0;  ///< vertex, or edge of Surface::edges
    std::uint32_t b = 0;  ///< triangle, or edge
};

/// The nearest vertex and triangle, or two edges, without a common vertex. `between_parts`: only of different
/// connected parts.
Nearest nearest_pair(const Surface& surface, const std::vector<glm::dvec3>& positions, bool between_parts);

/// The nearest point of a closed triangle: distance [m] and shares of the corners, which add up to 1.
struct NearestOfTriangle
{
    double distance = 0;
    glm::dvec3 shares{0};
};
NearestOfTriangle nearest_of_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);

/// The nearest points of two closed segments: distance [m] and how far along each they lie, 0..1.
struct NearestOfSegments
{
    double distance = 0, along_p = 0, along_q = 0;
};
NearestOfSegments nearest_of_segments(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& q0,
                                      const glm::dvec3& q1);

inline double distance_to_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle)
{
    return nearest_of_triangle(p, triangle).distance;
}

inline double distance_of_segments(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& q0,
                                   const glm::dvec3& q1)
{
    return nearest_of_segments(p0, p1, q0, q1).distance;
}

} // namespace taut::judging
