#pragma once
// Colliders as the references and errors see them: surfaces at one time.

#include "taut/scene/collider.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace taut::reference {

struct Touch
{
    glm::dvec3 normal{0}; ///< away from the collider
    double height = 0;    ///< m above the surface moved out by the gap; < 0 = inside
};

struct Surface
{
    ColliderSolid solid;
    ColliderFrame frame; ///< plane: y is the normal

    /// A box grows by the gap on every face, so outside its edges it is further away than this says.
    Touch touch(const glm::dvec3& x, double gap) const
    {
        glm::dvec3 own = frame.inside(x);
        if (!solid.bounded)
            return {frame.y, own.y - gap};
        if (solid.field)
        {
            const glm::dvec3 normal = solid.field_normal(own);
            return {frame.outside(normal) - frame.centre, solid.field_distance(own) - gap};
        }
        if (solid.is_box())
            return touch_box(own, gap);
        own -= glm::clamp(own, -solid.half, solid.half);
        const double distance = glm::length(own);
        const glm::dvec3 nowhere = solid.turns ? frame.x : frame.y;
        const glm::dvec3 out =
            distance > 0 ? (frame.outside(own) - frame.centre) / distance : nowhere;
        return {out, distance - solid.radius - gap};
    }

    /// How far the collider's point that is at x now, and was elsewhere when it lay as `before`, has come.
    glm::dvec3 carried(const Surface& before, const glm::dvec3& x) const
    {
        if (!solid.turns)
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
            const double height = std::abs(own[k]) - solid.half[k] - gap;
            if (height > out.height)
                out = {own[k] < 0 ? -axes[k] : axes[k], height};
        }
        return out;
    }
};

inline Surface surface_at(const Collider& collider, double time)
{
    return {solid_of(collider), frame_at(collider, time)};
}

} // namespace taut::reference
