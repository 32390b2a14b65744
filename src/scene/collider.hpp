#pragma once
// Where a collider is at a time, as a frame of its own.

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

/// Capsule: y is its axis; a capsule without length stands upright. Plane: y is its normal. Moved and turned
/// by the motion.
ColliderFrame frame_at(const Collider& collider, double time);

} // namespace taut
