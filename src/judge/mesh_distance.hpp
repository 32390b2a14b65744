#pragma once
// How far a place is from a closed surface of triangles, and on which side.

#include "taut/judge/box_tree.hpp"
#include "taut/scene/distance_field.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace taut::judging {

/// Triangles are wound counter-clockwise as seen from outside, every edge belongs to two. Questions may come
/// from several threads; the triangles and places must outlive it.
class MeshDistance
{
public:
    MeshDistance(std::span<const std::array<std::uint32_t, 3>> triangles,
                 std::span<const glm::dvec3> positions);

    /// m, below 0 inside; exact but for rounding where the surface does not cut itself.
    double at(const glm::dvec3& p) const;

private:
    /// Of the feature of triangle t where `shares` lie: the triangle, one of its edges or corners.
    glm::dvec3 way_out(std::uint32_t t, const glm::dvec3& shares) const;

    std::span<const std::array<std::uint32_t, 3>> triangles_;
    std::span<const glm::dvec3> positions_;
    std::vector<glm::dvec3> of_face_, of_corner_;
    std::vector<std::array<glm::dvec3, 3>> of_edge_; ///< [k]: from corner k to k + 1
    BoxTree tree_;
};

/// On a grid of cells of `cell` [m] round the surface with `margin` [m] beyond it on all sides. On all cores;
/// the same values however many there are.
DistanceField make_distance_field(const MeshDistance& surface, std::span<const glm::dvec3> positions,
                                  double cell, double margin);

} // namespace taut::judging
