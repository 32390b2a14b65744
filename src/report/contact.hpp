#pragma once
// Colliders as the references and errors see them: surfaces at one time.

#include "taut/scene/collider.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut::reference {

struct Touch
{
    glm::dvec3 normal{0}; ///< away from the collider
    double height = 0;    ///< m above the surface moved out by the gap; < 0 = inside
};

struct Surface
{
    ColliderKind kind = ColliderKind::plane;
    ColliderFrame frame; ///< plane: y is the normal
    double radius = 0;   ///< m: sphere, capsule
    glm::dvec3 half{0};  ///< m: cuboid

    /// A box grows by the gap on every face, so outside its edges it is further away than this says.
    Touch touch(const glm::dvec3& x, double gap) const
    {
        glm::dvec3 own = frame.inside(x);
        if (kind == ColliderKind::plane)
            return {frame.y, own.y - gap};
        if (kind == ColliderKind::cuboid)
            return touch_box(own, gap);
        if (kind == ColliderKind::capsule)
            own.y -= std::clamp(own.y, -frame.half_length, frame.half_length);
        const double distance = glm::length(own);
        const glm::dvec3 nowhere = kind == ColliderKind::capsule ? frame.x : frame.y;
        const glm::dvec3 out =
            distance > 0 ? (frame.outside(own) - frame.centre) / distance : nowhere;
        return {out, distance - radius - gap};
    }

    /// How far the collider's point that is at x now, and was elsewhere when it lay as `before`, has come.
    /// Balls do not spin.
    glm::dvec3 carried(const Surface& before, const glm::dvec3& x) const
    {
        if (kind == ColliderKind::plane || kind == ColliderKind::sphere)
            return frame.centre - before.frame.centre;
        return x - before.frame.outside(frame.inside(x));
    }

private:
    Touch touch_box(const glm::dvec3& own, double gap) const
    {
        const glm::dvec3 axes[] = {frame.x, frame.y, frame.z};
        Touch out{axes[0], -1e300};
        for (int k = 0; k < 3; ++k)
        {
            const double height = std::abs(own[k]) - half[k] - gap;
            if (height > out.height)
                out = {own[k] < 0 ? -axes[k] : axes[k], height};
        }
        return out;
    }
};

inline Surface surface_at(const Collider& collider, double time)
{
    return {collider.kind, frame_at(collider, time), collider.radius, collider.half_size};
}

} // namespace taut::reference
