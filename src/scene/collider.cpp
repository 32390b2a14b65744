#include "taut/scene/collider.hpp"

#include "taut/scene/distance_field.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <iterator>

namespace taut {
namespace {

/// x and z of a frame whose y is given.
void complete(ColliderFrame& frame)
{
    const glm::dvec3 other = std::abs(frame.y.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    frame.x = glm::normalize(other - glm::dot(other, frame.y) * frame.y);
    frame.z = glm::cross(frame.x, frame.y);
}

ColliderFrame at_point(const Collider& c)
{
    ColliderFrame out;
    out.centre = c.point;
    return out;
}

ColliderFrame plane_frame(const Collider& c)
{
    ColliderFrame out = at_point(c);
    out.y = glm::normalize(c.normal);
    complete(out);
    return out;
}

ColliderFrame capsule_frame(const Collider& c)
{
    ColliderFrame out;
    const glm::dvec3 way = c.end - c.point;
    const double length = glm::length(way);
    out.centre = c.point + 0.5 * way;
    out.half_length = 0.5 * length;
    out.y = length > 0 ? way / length : glm::dvec3(0, 1, 0);
    complete(out);
    return out;
}

ColliderFrame cuboid_frame(const Collider& c)
{
    ColliderFrame out = at_point(c);
    const std::vector<Keyframe> turn{{0, glm::dvec3(0), c.rotate_axis, c.rotate_degrees, glm::dvec3(0)}};
    for (glm::dvec3* axis : {&out.x, &out.y, &out.z})
        *axis = pose(turn, 0, *axis);
    return out;
}

ColliderFrame field_frame(const Collider& c)
{
    ColliderFrame out = cuboid_frame(c);
    out.centre = out.outside(c.field ? c.field->middle() : glm::dvec3(0));
    return out;
}

ColliderSolid plane_solid(const Collider&) { return {glm::dvec3(0), 0, false, false}; }
ColliderSolid sphere_solid(const Collider& c) { return {glm::dvec3(0), c.radius, true, false}; }
ColliderSolid capsule_solid(const Collider& c)
{
    return {{0, 0.5 * glm::length(c.end - c.point), 0}, c.radius, true, true};
}
ColliderSolid cuboid_solid(const Collider& c) { return {c.half_size, 0, true, true}; }
ColliderSolid field_solid(const Collider& c)
{
    return {c.field ? c.field->half_size() : glm::dvec3(0), 0, true, true, c.field.get()};
}

/// By ColliderKind.
constexpr struct
{
    ColliderFrame (*frame)(const Collider&);
    ColliderSolid (*solid)(const Collider&);
} kGeometry[] = {
    {plane_frame, plane_solid},
    {at_point, sphere_solid},
    {capsule_frame, capsule_solid},
    {cuboid_frame, cuboid_solid},
    {field_frame, field_solid},
};
static_assert(std::size(kGeometry) == kColliderKinds);

} // namespace

ColliderSolid solid_of(const Collider& c) { return kGeometry[static_cast<std::size_t>(c.kind)].solid(c); }

double ColliderSolid::field_distance(const glm::dvec3& own) const
{
    return field->distance(field->middle() + own);
}

glm::dvec3 ColliderSolid::field_normal(const glm::dvec3& own) const
{
    return field->normal(field->middle() + own);
}

ColliderFrame rest_frame(const Collider& c) { return kGeometry[static_cast<std::size_t>(c.kind)].frame(c); }

glm::dvec3 ColliderFrame::inside(const glm::dvec3& world) const
{
    const glm::dvec3 from = world - centre;
    return {glm::dot(from, x), glm::dot(from, y), glm::dot(from, z)};
}

glm::dvec3 ColliderFrame::outside(const glm::dvec3& own) const
{
    return centre + own.x * x + own.y * y + own.z * z;
}

ColliderFrame frame_at(const Collider& collider, double time)
{
    ColliderFrame out = rest_frame(collider);
    if (collider.motion.empty())
        return out;
    const glm::dvec3 centre = pose(collider.motion, time, out.centre);
    for (glm::dvec3* axis : {&out.x, &out.y, &out.z})
        *axis = glm::normalize(pose(collider.motion, time, out.centre + *axis) - centre);
    out.centre = centre;
    return out;
}

} // namespace taut
