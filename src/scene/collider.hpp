#pragma once
// Where a collider is at a time, as a frame of its own, and what it fills there.

#include "taut/scene/scene.hpp"

namespace taut {

/// Axes are unit vectors at right angles, in the world.
struct ColliderFrame
{
    glm::dvec3 centre{0}; ///< m; plane: a point on it
    glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    double half_length = 0; ///< m, capsule: of its axis, along y

    /// A point of the world as seen from the frame, and back.
    glm::dvec3 inside(const glm::dvec3& world) const;
    glm::dvec3 outside(const glm::dvec3& own) const;
};

/// What a collider fills in its own frame: all points within `radius` of the box of half sizes `half`, which
/// is a line along y in a capsule and a point in a ball. A plane fills what is below it; of a `field`, whose
/// frame stands in the middle of its grid, `half` is the box round it.
struct ColliderSolid
{
    glm::dvec3 half{0};
    double radius = 0;
    bool bounded = true;
    bool turns = true; ///< with its motion, as far as what touches it can tell: balls do not spin

    const DistanceField* field = nullptr; ///< the collider's own

    bool is_box() const { return bounded && radius == 0 && !field; }
    /// m and of length 1: of the `field` at a point of the frame.
    double field_distance(const glm::dvec3& own) const;
    glm::dvec3 field_normal(const glm::dvec3& own) const;
};
ColliderSolid solid_of(const Collider& collider);

/// Capsule: y is its axis; a capsule without length stands upright. Plane: y is its normal.
ColliderFrame rest_frame(const Collider& collider);
/// Moved and turned by the motion.
ColliderFrame frame_at(const Collider& collider, double time);

} // namespace taut
