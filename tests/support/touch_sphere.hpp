#pragma once
// What a ball says to a vertex, in fp64 from the written rules, and random balls.

#include "support/contacts.hpp"

namespace taut::conformance {

template <typename Real>
layout::SphereCollider<Real> make_sphere(const glm::dvec3& start, const glm::dvec3& end, double radius,
                                         double friction)
{
    const auto r = [](double x) { return static_cast<Real>(x); };
    return {r(start.x), r(start.y), r(start.z), r(end.x), r(end.y), r(end.z), r(radius), r(friction)};
}

/// The first time in [0, 1] at which a point on the way from `a` to `e` enters the ball of radius r about 0,
/// by bisection; 2 if it does not, or starts inside by more than r / 2000. `doubtful` when a rounding could
/// decide otherwise.
inline double time_of_entry(const glm::dvec3& a, const glm::dvec3& e, double r, bool& doubtful)
{
    const auto outside = [&](double t) { return glm::length(a + (e - a) * t) - r; };
    const double travel = glm::length(e - a);
    doubtful = std::abs(glm::dot(a, a) / (r * r) - 0.999) < 1e-4;
    if (travel == 0 || glm::dot(a, a) < 0.999 * r * r)
        return 2;
    if (outside(0) < 0)
        return glm::dot(a, e - a) < 0 ? 0 : 2;
    const double nearest = std::clamp(-glm::dot(a, e - a) / (travel * travel), 0.0, 1.0);
    doubtful = doubtful || (std::abs(outside(nearest)) < 1e-3 * r && nearest > 0); // grazes
    if (nearest == 0 || outside(nearest) >= 0)
        return 2;
    double before = 0, after = nearest;
    for (int i = 0; i < 200; ++i)
    {
        const double middle = (before + after) / 2;
        (outside(middle) > 0 ? before : after) = middle;
    }
    return before;
}

/// In the frame of the ball: a vertex that ends inside, on the side that it came from, leaves by the nearest
/// point; one that entered and went past the centre or out again is stopped where it entered.
template <typename Real>
Touch touch_sphere(const layout::SphereCollider<Real>& c, const Contacts<Real>& in, const glm::dvec3& x,
                   const glm::dvec3& d, double kept)
{
    const auto r = [](Real v) { return static_cast<double>(v); };
    const glm::dvec3 start(r(c.start_x), r(c.start_y), r(c.start_z)), end(r(c.end_x), r(c.end_y), r(c.end_z));
    const double radius = r(c.radius) + kept, steps = in.substeps;
    const glm::dvec3 here = start + (end - start) * (in.substep / steps);
    const glm::dvec3 there = start + (end - start) * ((in.substep + 1) / steps);
    const glm::dvec3 a = x - here, e = x + d - there;
    bool doubtful = false;
    const double entry = time_of_entry(a, e, radius, doubtful);
    const bool same_side = glm::dot(a, e) > 0 && glm::length(e) < radius;
    doubtful = doubtful || (entry <= 1 && std::abs(glm::dot(a, e)) < 1e-4 * glm::length(a) * radius);
    const glm::dvec3 towards = entry <= 1 && !same_side ? a + (e - a) * entry : e;
    const double size = glm::length(towards);
    Touch t;
    t.normal = size > 0 ? towards / size : glm::dvec3(0, 1, 0);
    t.gap_before = glm::length(a) - radius;
    t.gap = glm::dot(t.normal, e) - radius;
    t.shift = there - here;
    t.friction = r(c.friction);
    // A direction found from a small vector, or from a flat crossing, turns by its rounding.
    const double terms = glm::length(x) + glm::length(d) + glm::length(here) + glm::length(t.shift) + radius;
    const double slope = entry <= 1 ? std::abs(glm::dot(t.normal, e - a)) / glm::length(e - a) : 1;
    const double turn = size > 0 ? (glm::length(e) + radius) / (size * slope) : 1;
    t.size = doubtful ? kAnyFinite : terms * (1 + turn);
    t.normal_size = 1 + (size > 0 ? terms / (size * slope) : 0);
    return t;
}

/// The first rests at the origin, so that exact contact can be planted; others move.
template <typename Real>
std::vector<layout::SphereCollider<Real>> random_spheres(Random& random, std::uint32_t colliders)
{
    std::vector spheres{make_sphere<Real>({0, 0, 0}, {0, 0, 0}, 0.5, 0.5)};
    while (spheres.size() < colliders)
    {
        const glm::dvec3 start(random.vec4<double>(1, 0)), way(random.vec4<double>(0.3, 0));
        spheres.push_back(
            make_sphere<Real>(start, start + way, random.uniform(0.2, 0.6), random.uniform(0, 1)));
    }
    return spheres;
}

} // namespace taut::conformance
