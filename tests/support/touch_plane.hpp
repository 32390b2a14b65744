#pragma once
// What a plane says to a vertex, in fp64 from the written rules, and random planes.

#include "support/contacts.hpp"

namespace taut::conformance {

template <typename Real>
layout::PlaneCollider<Real> make_plane(const glm::dvec3& normal, double start, double end,
                                       const glm::dvec3& shift, double friction)
{
    const auto r = [](double x) { return static_cast<Real>(x); };
    return {r(normal.x), r(normal.y), r(normal.z), r(start),   r(end),
            r(shift.x),  r(shift.y),  r(shift.z),  r(friction)};
}

/// Half-space {x : n.x >= offset}; the offset and the drag move linearly over the substeps.
template <typename Real>
Touch touch_plane(const layout::PlaneCollider<Real>& c, const Contacts<Real>& in, const glm::dvec3& x,
                  const glm::dvec3& d, double kept)
{
    const auto r = [](Real v) { return static_cast<double>(v); };
    const double start = r(c.offset_start), end = r(c.offset_end), steps = in.substeps;
    const double here = start + (end - start) * in.substep / steps;
    const double there = start + (end - start) * (in.substep + 1) / steps;
    Touch t;
    t.normal = {r(c.normal_x), r(c.normal_y), r(c.normal_z)};
    t.gap_before = glm::dot(t.normal, x) - here - kept;
    t.gap = glm::dot(t.normal, x + d) - there - kept;
    t.shift = glm::dvec3(r(c.shift_x), r(c.shift_y), r(c.shift_z)) / steps;
    t.friction = r(c.friction);
    t.size = glm::length(x) + glm::length(d) + std::abs(here) + std::abs(there - here) + kept +
             glm::length(t.shift);
    return t;
}

/// The first is level and at rest, so that exact contact can be planted; others move and drag.
template <typename Real>
std::vector<layout::PlaneCollider<Real>> random_planes(Random& random, std::uint32_t colliders)
{
    std::vector planes{make_plane<Real>({0, 1, 0}, -0.5, -0.5, {0, 0, 0}, 0.5)};
    while (planes.size() < colliders)
    {
        const glm::dvec3 normal = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
        const glm::dvec3 shift(random.vec4<double>(0.2, 0));
        const double start = random.uniform(-1, -0.3);
        planes.push_back(
            make_plane<Real>(normal, start, start + random.uniform(-0.2, 0.2), shift, random.uniform(0, 1)));
    }
    return planes;
}

} // namespace taut::conformance
