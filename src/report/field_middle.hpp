#pragma once
// What a distance field is thickest at, all along: points of its medial axis.

#include "taut/scene/distance_field.hpp"

#include <array>
#include <vector>

namespace taut {

struct DeepPoint
{
    glm::dvec3 place{0}; ///< m, from the middle of the grid
    double depth = 0;    ///< m, > 0, below the surface
    glm::dvec3 half{0};  ///< m, half of how far the inside goes on along each axis through it
};

/// Points of the grid where the distance hardly changes, since as much of the surface lies on one side as on
/// the other: of a plate its middle plane, of a limb its axis. None is nearer to another than its depth;
/// where that would be more than 256, they are further apart.
std::vector<DeepPoint> deep_points(const DistanceField& field);

/// m, >= 0: of the deepest of 45 points of a triangle whose corners are seen from the middle of the grid.
double depth_in_field(const DistanceField& field, const std::array<glm::dvec3, 3>& triangle);

/// Whether one of them is deeper than half of the nearest of the field's deep points.
bool lies_deep_in_field(const DistanceField& field, const std::vector<DeepPoint>& deep,
                        const std::array<glm::dvec3, 3>& triangle);

} // namespace taut
