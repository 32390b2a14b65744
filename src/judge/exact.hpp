#pragma once
// Exact answers on the bits of the coordinates: on which side a point lies, and whether a segment meets a
// triangle. No tolerance anywhere.
// Based on: Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", for the bound below which a rounded determinant decides nothing. Departures: what the bound
// leaves open is computed with the rational numbers of GMP, in one stage.

#include <glm/vec3.hpp>

#include <array>

namespace taut::judging {

/// Sign of ((b - a) x (c - a)) . (d - a): +1, 0 or -1. Coordinates are finite, at most 1e30 in magnitude.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// Whether the closed segment pq and the closed triangle have a point in common; touching counts, and so do
/// triangles without area, which are segments or points.
bool segment_meets_triangle(const glm::dvec3& p, const glm::dvec3& q,
                            const std::array<glm::dvec3, 3>& triangle);

} // namespace taut::judging
