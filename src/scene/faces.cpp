#include "taut/scene/faces.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double kSeen = 0.25; ///< of the hole

/// m: how far the collider can stand out of a hole.
double stands_out(const Collider& collider, double hole)
{
    if (collider.kind == ColliderKind::cuboid || hole >= collider.radius)
        return hole;
    return collider.radius - std::sqrt(collider.radius * collider.radius - hole * hole);
}

} // namespace

double hole_of(const std::array<glm::dvec3, 3>& t)
{
    double edges[] = {glm::length(t[1] - t[0]), glm::length(t[2] - t[1]), glm::length(t[0] - t[2])};
    std::sort(std::begin(edges), std::end(edges));
    if (edges[0] * edges[0] + edges[1] * edges[1] <= edges[2] * edges[2])
        return 0.5 * edges[2];
    return edges[0] * edges[1] * edges[2] / (2 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])));
}

double largest_hole(const Body& body)
{
    double out = 0;
    for (const auto& t : body.mesh.triangles)
        out = std::max(
            out, hole_of({body.mesh.positions[t[0]], body.mesh.positions[t[1]], body.mesh.positions[t[2]]}));
    return out;
}

bool has_faces(ColliderKind kind)
{
    return kind != ColliderKind::plane && kind != ColliderKind::distance_field;
}

bool SurfaceRule::meets(const Collider& collider)
{
    if (!has_faces(collider.kind) || body_.kinematic.used || body_.mesh.triangles.empty() ||
        collider.meets == ColliderMeets::vertices)
        return false;
    if (collider.meets == ColliderMeets::surface)
        return true;
    if (!hole_)
        hole_ = largest_hole(body_);
    return stands_out(collider, *hole_) > kSeen * *hole_ + body_.material.thickness;
}

} // namespace taut
