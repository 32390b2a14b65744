#pragma once
// What a box says to a vertex, in fp64 from the written rules, and random boxes.

#include "support/turned.hpp"

namespace taut::conformance {

template <typename Real>
layout::CuboidCollider<Real> make_cuboid(const Frame& frame, const glm::dvec3& half, double friction)
{
    layout::CuboidCollider<Real> c{};
    put_frame<Real>(c, frame);
    c.half_x = static_cast<Real>(half.x);
    c.half_y = static_cast<Real>(half.y);
    c.half_z = static_cast<Real>(half.z);
    c.friction = static_cast<Real>(friction);
    return c;
}

/// Height over the highest of the six faces, and which that is; `lead` over the next pair of faces.
struct BoxFace
{
    glm::dvec3 normal{0};
    double height = 0, lead = 0, extent = 0;
};

inline BoxFace highest_face(const glm::dvec3& p, const glm::dvec3& extent)
{
    BoxFace best;
    best.height = -1e300;
    for (int k = 0; k < 3; ++k)
        for (const double side : {1.0, -1.0})
        {
            const double height = side * p[k] - extent[k];
            if (height > best.height)
            {
                best.normal = glm::dvec3(0);
                best.normal[k] = side;
                best.height = height;
                best.extent = extent[k];
            }
        }
    best.lead = 1e300;
    for (int k = 0; k < 3; ++k)
        if (best.normal[k] == 0)
            best.lead = std::min(best.lead, best.height - (std::abs(p[k]) - extent[k]));
    return best;
}

/// A face that a vertex is at, or a rounding behind, and moves into: it counts as outside of it.
inline bool enters_at_once(const Way& way, const glm::dvec3& extent, BoxFace& face, bool& doubtful)
{
    int found = 0;
    for (int k = 0; k < 3; ++k)
    {
        const double v = way.e[k] - way.a[k];
        if (v == 0)
            continue;
        const double side = v < 0 ? 1 : -1, height = side * way.a[k] - extent[k];
        doubtful = doubtful || std::abs(height + 5e-4 * extent[k]) < 5e-6;
        if (height < -5e-4 * extent[k] || height > 0)
            continue;
        if (++found == 1)
        {
            face = {};
            face.normal[k] = side;
            face.extent = extent[k];
        }
    }
    return found > 0;
}

/// In the frame of the box: the face by which a vertex enters decides; one that starts inside is told by the
/// face nearest to where it was.
template <typename Real>
Touch touch_cuboid(const std::vector<layout::CuboidCollider<Real>>& poses, const Contacts<Real>& in,
                   std::uint32_t j, const glm::dvec3& x, const glm::dvec3& d, double kept)
{
    const layout::CuboidCollider<Real>& c = poses[in.substep * in.colliders + j];
    const glm::dvec3 half(c.half_x, c.half_y, c.half_z), extent = half + kept;
    const Way way = way_of(poses, in, j, x, d);
    const auto outside = [&](double t) { return highest_face(way.at(t), extent).height; };
    const BoxFace start = highest_face(way.a, extent);
    BoxFace face = start;
    bool doubtful = false, touches = start.height <= 0;
    if (start.height > 0)
    {
        double least = 0;
        const double entry = time_of_entry(outside, least);
        doubtful = std::abs(least) < 1e-3;
        touches = entry <= 1;
        if (touches)
            face = highest_face(way.at(entry), extent);
        const double slope = std::abs(glm::dot(face.normal, way.e - way.a));
        doubtful = doubtful || (touches && face.lead < 1e-3 * (way.length() + slope));
    }
    else if (!enters_at_once(way, extent, face, doubtful))
        doubtful = doubtful || face.lead < 1e-5;
    doubtful = doubtful || (start.height != 0 && std::abs(start.height) < 1e-6);
    Touch t;
    t.normal = way.end.turned(face.normal);
    t.gap_before = touches ? glm::dot(face.normal, way.a) - face.extent : 0;
    t.gap = touches ? glm::dot(face.normal, way.e) - face.extent : 0;
    t.friction = static_cast<double>(c.friction);
    add_slide(t, way, d);
    t.size = doubtful ? kAnyFinite : 3 * (way.terms + glm::length(extent));
    return t;
}

/// Poses at the ends of substeps. The first lies at the origin; others go and turn.
template <typename Real>
std::vector<layout::CuboidCollider<Real>> random_cuboids(Random& random, std::uint32_t substeps,
                                                         std::uint32_t colliders)
{
    std::vector<layout::CuboidCollider<Real>> poses((substeps + 1) * colliders);
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        const Drift drift = random_drift(random);
        const glm::dvec3 half(random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5));
        const double friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= substeps; ++s)
            poses[s * colliders + j] = j == 0 ? make_cuboid<Real>({}, {1, 0.5, 0.25}, 0.5)
                                              : make_cuboid<Real>(drift.at(s), half, friction);
    }
    return poses;
}

} // namespace taut::conformance
