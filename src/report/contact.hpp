#pragma once
// Colliders as the references and errors see them: surfaces at one time.

#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

namespace taut::reference {

struct Touch
{
    glm::dvec3 normal{0}; ///< away from the collider
    double height = 0;    ///< m above the surface moved out by the gap; < 0 = inside
};

struct Surface
{
    bool plane = false;
    glm::dvec3 point{0};  ///< m: on the plane, or the centre
    glm::dvec3 normal{0}; ///< unit, planes only
    double radius = 0;    ///< m

    Touch touch(const glm::dvec3& x, double gap) const
    {
        if (plane)
            return {normal, glm::dot(normal, x - point) - gap};
        const double distance = glm::distance(x, point);
        const glm::dvec3 out = distance > 0 ? (x - point) / distance : glm::dvec3(0, 1, 0);
        return {out, distance - radius - gap};
    }
};

inline Surface surface_at(const Collider& collider, double time)
{
    Surface out;
    out.plane = collider.kind == ColliderKind::plane;
    out.point = pose(collider.motion, time, collider.point);
    out.radius = collider.radius;
    if (out.plane)
        out.normal = glm::normalize(pose(collider.motion, time, collider.normal) -
                                    pose(collider.motion, time, glm::dvec3(0)));
    return out;
}

} // namespace taut::reference
