#pragma once
// Whether colliders meet the triangles of a body or its vertices alone.

#include "taut/scene/scene.hpp"

#include <array>
#include <optional>

namespace taut {

/// Radius of the smallest ball round a triangle, m: what is less wide may pass between the corners.
double hole_of(const std::array<glm::dvec3, 3>& triangle);

/// The largest of a body's triangles at rest, m; 0 without any.
double largest_hole(const Body& body);

/// Whether there are passes over triangles for a collider of that kind. Of a plane vertices say it all;
/// points between the vertices of a triangle are not looked for in a distance field.
bool has_faces(ColliderKind kind);

/// Which colliders meet the surface of a body of a resolved scene. ColliderMeets::automatic: where the
/// collider could stand out between vertices that just do not touch it by a quarter of the largest hole and
/// the body's thickness. That is the whole hole at an edge of a box, r - sqrt(r^2 - hole^2) of a ball or a
/// capsule. Of kinematic bodies never. The body must outlive it.
class SurfaceRule
{
public:
    explicit SurfaceRule(const Body& body) : body_(body) {}
    bool meets(const Collider& collider);

private:
    const Body& body_;
    std::optional<double> hole_; ///< m; triangles are measured once, and only where it matters
};

/// The same of one pair; over many a SurfaceRule measures the triangles once.
inline bool meets_surface(const Body& body, const Collider& collider)
{
    return SurfaceRule(body).meets(collider);
}

} // namespace taut
