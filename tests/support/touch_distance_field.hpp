#pragma once
// What a distance field says to a vertex, in fp64 from the written rules, and fields of a ball, a box, a
// torus.

#include "support/box_distance.hpp"
#include "support/turned.hpp"

#include <functional>

namespace taut::conformance {

/// A grid and what it holds.
struct DistanceGrid
{
    glm::uvec3 points{0};
    glm::dvec3 low{0};
    double cell = 0;
    std::vector<double> values; ///< as the kernel gets them: rounded

    double value(const glm::ivec3& at) const
    {
        const auto u = glm::uvec3(at);
        return values[u.x + points.x * (u.y + points.y * u.z)];
    }

    /// The eight points round a place, each by the volume across from it; from beyond the grid by Pythagoras.
    double distance(const glm::dvec3& p) const
    {
        const glm::dvec3 at = (p - low) / cell;
        const glm::dvec3 q = glm::clamp(at, glm::dvec3(0), glm::dvec3(points) - 1.0);
        const glm::ivec3 first = glm::min(glm::ivec3(glm::floor(q)), glm::ivec3(points) - 2);
        const glm::dvec3 share = q - glm::dvec3(first);
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
            const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
            double part = 1;
            for (int axis = 0; axis < 3; ++axis)
                part *= side[axis] == 1 ? share[axis] : 1 - share[axis];
            sum += part * value(first + side);
        }
        const double off = glm::length(at - q) * cell;
        return off > 0 ? std::hypot(off, sum) : sum;
    }

    /// By what it changes over a cell along each axis; its size comes back in `slope`.
    glm::dvec3 normal(const glm::dvec3& p, double& slope) const
    {
        glm::dvec3 change(0);
        for (int axis = 0; axis < 3; ++axis)
        {
            glm::dvec3 step(0);
            step[axis] = cell / 2;
            change[axis] = distance(p + step) - distance(p - step);
        }
        slope = glm::length(change) / cell;
        return slope > 0 ? glm::normalize(change) : glm::dvec3(0, 1, 0);
    }
};

template <typename Real>
DistanceGrid make_distance_grid(const glm::uvec3& points, const glm::dvec3& low, double cell,
                                const std::function<double(const glm::dvec3&)>& distance)
{
    DistanceGrid out{
        points, glm::dvec3(glm::vec<3, Real>(low)), static_cast<double>(static_cast<Real>(cell)), {}};
    for (unsigned k = 0; k < points.z; ++k)
        for (unsigned j = 0; j < points.y; ++j)
            for (unsigned i = 0; i < points.x; ++i)
                out.values.push_back(static_cast<double>(
                    static_cast<Real>(distance(out.low + out.cell * glm::dvec3(i, j, k)))));
    return out;
}

template <typename Real>
layout::DistanceFieldCollider<Real> make_distance_field(const Frame& frame, const DistanceGrid& grid,
                                                        std::size_t first, double friction)
{
    layout::DistanceFieldCollider<Real> c{};
    put_frame<Real>(c, frame);
    c.low_x = static_cast<Real>(grid.low.x);
    c.low_y = static_cast<Real>(grid.low.y);
    c.low_z = static_cast<Real>(grid.low.z);
    c.cell = static_cast<Real>(grid.cell);
    c.friction = static_cast<Real>(friction);
    c.count_x = grid.points.x;
    c.count_y = grid.points.y;
    c.count_z = grid.points.z;
    c.first = static_cast<std::uint32_t>(first);
    return c;
}

struct FieldEntry
{
    double time = 2; ///< 2: never
    bool doubtful = false;
};

/// The first time at which a way is not above 0, looked for in 1,000 places. Doubtful where it hardly dips
/// below, or leaves again sooner than the kernel promises to notice.
inline FieldEntry entry_of(const std::function<double(double)>& height, double rounding)
{
    constexpr int kPlaces = 1000;
    FieldEntry out;
    int in = 0;
    double deepest = 0, last = height(0);
    bool falls = false;
    for (int n = 1; n <= kPlaces && !out.doubtful; ++n)
    {
        const double now = height(n / double(kPlaces));
        if (in == 0 && now > 0)
            out.doubtful = falls && now > last && last < rounding;
        if (in == 0 && now <= 0)
            in = n;
        deepest = std::min(deepest, in > 0 ? now : 0.0);
        if (in > 0 && now > 0 && n - in < kPlaces / 32 + 2)
            out.doubtful = true;
        falls = now < last;
        last = now;
    }
    if (in == 0)
        return out;
    out.doubtful = out.doubtful || -deepest < 4 * rounding;
    double before = (in - 1) / double(kPlaces), after = in / double(kPlaces);
    for (int n = 0; n < 60; ++n)
    {
        const double middle = (before + after) / 2;
        (height(middle) > 0 ? before : after) = middle;
    }
    out.time = before;
    return out;
}

template <typename Real>
struct DistanceFields
{
    std::vector<DistanceGrid> grids; ///< one a collider
    std::vector<layout::DistanceFieldCollider<Real>> poses;

    /// Those of all grids, as the kernel gets them; a buffer cannot be empty.
    std::vector<Real> values() const
    {
        std::vector<Real> out;
        for (const DistanceGrid& grid : grids)
            for (const double value : grid.values)
                out.push_back(static_cast<Real>(value));
        if (out.empty())
            out.push_back(0);
        return out;
    }
};

template <typename Real>
Touch touch_distance_field(const DistanceFields<Real>& shapes, const Contacts<Real>& in, std::uint32_t j,
                           const glm::dvec3& x, const glm::dvec3& d, double kept)
{
    const DistanceGrid& grid = shapes.grids[j];
    const Way way = way_of(shapes.poses, in, j, x, d);
    const double before = grid.distance(way.a) - kept, after = grid.distance(way.e) - kept;
    const double rounding = 64 * std::numeric_limits<Real>::epsilon() * (way.terms + 2);
    double slope = 1;
    glm::dvec3 own(0, 1, 0);
    const double reach = std::min(before, after) - way.length() - grid.cell;
    bool doubtful = std::abs(reach) < rounding || std::abs(before) < rounding ||
                    std::abs(way.length() - grid.cell / 2) < rounding;
    Touch t;
    t.gap_before = before;
    t.gap = after;
    double way_terms = 0;
    if (reach < 0)
        own = grid.normal(before > 0 ? way.e : way.a, slope);
    if (reach < 0 && before <= 0)
        t.gap = before + glm::dot(own, way.e - way.a);
    else if (reach < 0 && way.length() > grid.cell / 2)
    {
        const FieldEntry entry =
            entry_of([&](double time) { return grid.distance(way.at(time)) - kept; }, rounding);
        const glm::dvec3 meets = way.at(std::min(entry.time, 1.0));
        double slope_there = 1;
        const glm::dvec3 first = grid.normal(meets, slope_there);
        const bool in_doubt = entry.doubtful || std::abs(glm::dot(first, own) - 0.3) < 1e-3;
        doubtful = doubtful || in_doubt || (entry.time <= 1 && std::abs(after) < rounding);
        if (entry.time <= 1 && (after >= 0 || glm::dot(first, own) <= 0.3))
        {
            own = first;
            t.gap = glm::dot(first, way.e - meets);
            slope = slope_there;
            // A later entry by u of the way is u |e - a|: by how steeply it goes in.
            const double steep = std::abs(glm::dot(first, way.e - way.a)) / way.length();
            way_terms = way.length() / std::max(steep, 1e-3);
            doubtful = doubtful || steep < 0.02;
        }
    }
    t.normal = way.end.turned(own);
    t.friction = static_cast<double>(shapes.poses[j].friction);
    add_slide(t, way, d);
    doubtful = doubtful || slope < 0.1; // near the middle of the shape
    const double terms = way.terms + 2 + way_terms, bend = 1 / (grid.cell * slope);
    t.size = doubtful ? kAnyFinite : terms * (2 + (std::abs(t.gap) + way.length()) * bend);
    t.normal_size = 1 + terms * bend;
    return t;
}

inline double field_of_ball(const glm::dvec3& p) { return glm::length(p) - 0.5; }

inline double field_of_box(const glm::dvec3& p) { return test::box_distance(p, {0.4, 0.3, 0.5}); }

inline double field_of_torus(const glm::dvec3& p)
{
    return std::hypot(std::hypot(p.x, p.z) - 0.5, p.y) - 0.2;
}

/// Poses at the ends of substeps. The first, a ball, rests at the origin; a box and a torus go and turn.
template <typename Real>
DistanceFields<Real> random_distance_fields(Random& random, std::uint32_t substeps, std::uint32_t colliders)
{
    DistanceFields<Real> shapes;
    shapes.poses.resize((substeps + 1) * colliders);
    std::size_t first = 0;
    for (std::uint32_t j = 0; j < colliders; ++j)
    {
        const auto& distance = j == 0 ? field_of_ball : j == 1 ? field_of_box : field_of_torus;
        shapes.grids.push_back(
            make_distance_grid<Real>({17 + j, 18, 19}, {-0.9, -0.85, -0.91}, 0.1, distance));
        const Drift drift = random_drift(random);
        const double friction = random.uniform(0, 1);
        for (std::uint32_t s = 0; s <= substeps; ++s)
            shapes.poses[s * colliders + j] =
                make_distance_field<Real>(j == 0 ? Frame{} : drift.at(s), shapes.grids[j], first, friction);
        first += shapes.grids[j].values.size();
    }
    return shapes;
}

} // namespace taut::conformance
