#pragma once
// What a capsule says to a vertex, in fp64 from the written rules, and random capsules.

#include "support/turned.hpp"

namespace taut::conformance {

template <typename Real>
layout::CapsuleCollider<Real> make_capsule(const Frame& frame, double half_length, double radius,
                                           double friction)
{
    layout::CapsuleCollider<Real> c{};
    put_frame<Real>(c, frame);
    c.half_length = static_cast<Real>(half_length);
    c.radius = static_cast<Real>(radius);
    c.friction = static_cast<Real>(friction);
    return c;
}

/// From the segment between (0, -half, 0) and (0, half, 0), its nearest point by the three cases.
inline glm::dvec3 from_segment(const glm::dvec3& p, double half)
{
    const glm::dvec3 top(0, half, 0), bottom(0, -half, 0);
    return p.y > half ? p - top : p.y < -half ? p - bottom : glm::dvec3(p.x, 0, p.z);
}

/// In the frame of the capsule: a vertex that ends inside, on the side that it came from, leaves by the
/// nearest point; one that entered and went past the axis or out again is stopped where it entered.
template <typename Real>
Touch touch_capsule(const std::vector<layout::CapsuleCollider<Real>>& poses, const Contacts<Real>& in,
                    std::uint32_t j, const glm::dvec3& x, const glm::dvec3& d, double kept)
{
    const layout::CapsuleCollider<Real>& c = poses[in.substep * in.colliders + j];
    const double half = static_cast<double>(c.half_length), r = static_cast<double>(c.radius) + kept;
    const Way way = way_of(poses, in, j, x, d);
    const auto distance = [&](const glm::dvec3& p) { return glm::length(from_segment(p, half)); };
    const glm::dvec3 qa = from_segment(way.a, half), qe = from_segment(way.e, half);
    double least = 0, entry = 2;
    const double depth = distance(way.a) / r;
    bool doubtful = std::abs(depth * depth - 0.999) < 1e-4;
    if (way.length() > 0 && depth * depth >= 0.999)
    {
        entry = time_of_entry([&](double t) { return distance(way.at(t)) - r; }, least);
        if (distance(way.a) < r) // a rounding inside counts as the surface
            entry = glm::dot(qa, way.e - way.a) < 0 ? 0 : 2;
        else
            doubtful = doubtful || std::abs(least) < 1e-3 * r; // grazes
    }
    const bool same_side = glm::dot(qa, qe) > 0 && glm::length(qe) < r;
    doubtful = doubtful || (entry <= 1 && std::abs(glm::dot(qa, qe)) < 1e-4 * glm::length(qa) * r);
    const glm::dvec3 meets = entry <= 1 && !same_side ? way.at(entry) : way.e;
    const glm::dvec3 towards = from_segment(meets, half);
    const double size = glm::length(towards);
    const glm::dvec3 own = size > 0 ? towards / size : glm::dvec3(1, 0, 0);
    Touch t;
    t.normal = way.end.turned(own);
    t.gap_before = distance(way.a) - r;
    t.gap = glm::dot(own, way.e - (meets - towards)) - r;
    t.friction = static_cast<double>(c.friction);
    add_slide(t, way, d);
    const double slope = entry <= 1 ? std::abs(glm::dot(own, way.e - way.a)) / way.length() : 1;
    const double turn = size > 0 ? (distance(way.e) + r) / (size * slope) : 1;
    const double terms = way.terms + half + r;
    t.size = doubtful ? kAnyFinite : terms * (2 + turn);
    t.normal_size = 1 + (size > 0 ? terms / (size * slope) : 0);
    return t;
}

/// Poses at the ends of substeps. The first stands at the origin; others go and turn.
template <typename Real>
std::vector<layout::CapsuleCollider<Real>> random_capsules(Random& random, std::uint32_t substeps,
                                                           std::uint32_t colliders)
{
    std::vector<layout::CapsuleCollider<Real>> poses((substeps + 1) * colliders);
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        const Drift drift = random_drift(random);
        const double half = random.uniform(0, 0.5);
        const double radius = random.uniform(0.2, 0.4), friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= substeps; ++s)
            poses[s * colliders + j] = j == 0 ? make_capsule<Real>({}, 0.5, 0.5, 0.5)
                                              : make_capsule<Real>(drift.at(s), half, radius, friction);
    }
    return poses;
}

} // namespace taut::conformance
