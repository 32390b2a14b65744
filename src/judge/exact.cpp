#include "taut/judge/exact.hpp"

#include <glm/geometric.hpp>

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace taut::judging {
namespace {

constexpr double kRounding = 0x1p-53; ///< unit roundoff of double
constexpr double kTiny = 1e-250;      ///< products below may have lost bits by underflow

using Rational = mpq_class;

int sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
    std::array<std::array<Rational, 3>, 3> m;
    const std::array<const glm::dvec3*, 3> ends{&b, &c, &d};
    for (std::size_t row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k)
            m[row][static_cast<std::size_t>(k)] = Rational((*ends[row])[k]) - Rational(a[k]);
    const Rational determinant = m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]) +
                                 m[2][1] * (m[0][2] * m[1][0] - m[0][0] * m[1][2]) +
                                 m[2][2] * (m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    return sgn(determinant);
}

/// Points of the plane that is left when the coordinate `axis` is dropped.
struct Flat
{
    int x, y;
    explicit Flat(int axis) : x((axis + 1) % 3), y((axis + 2) % 3) {}

    /// Sign of (b - a) x (c - a).
    int turn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const
    {
        const double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
        const double size = std::abs(left) + std::abs(right);
        // Shewchuk's bound (3 + 16 u) u of orient2d.
        if (size > kTiny && std::abs(left - right) > (3 + 16 * kRounding) * kRounding * size)
            return sign(left - right);
        const Rational ax(a[x]), ay(a[y]);
        return sgn(Rational((Rational(b[x]) - ax) * (Rational(c[y]) - ay) -
                            (Rational(b[y]) - ay) * (Rational(c[x]) - ax)));
    }

    /// Of a point that is on the line through p and q: whether it lies between them.
    bool between(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& point) const
    {
        return std::min(p[x], q[x]) <= point[x] && point[x] <= std::max(p[x], q[x]) &&
               std::min(p[y], q[y]) <= point[y] && point[y] <= std::max(p[y], q[y]);
    }

    bool segments_meet(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a,
                       const glm::dvec3& b) const
    {
        const int pa = turn(p, q, a), pb = turn(p, q, b), ap = turn(a, b, p), aq = turn(a, b, q);
        if (pa * pb < 0 && ap * aq < 0)
            return true;
        return (pa == 0 && between(p, q, a)) || (pb == 0 && between(p, q, b)) ||
               (ap == 0 && between(a, b, p)) || (aq == 0 && between(a, b, q));
    }

    bool inside(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) const
    {
        const int s0 = turn(t[0], t[1], p), s1 = turn(t[1], t[2], p), s2 = turn(t[2], t[0], p);
        return (s0 > 0 && s1 > 0 && s2 > 0) || (s0 < 0 && s1 < 0 && s2 < 0);
    }

    bool segment_meets(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t) const
    {
        return segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) ||
               segments_meet(p, q, t[2], t[0]) || inside(t, p);
    }
};

/// Of five points in one plane. What has a point in common has one in each projection; and one of the three
/// projections keeps the points of the plane apart, so what meets in all of them meets.
bool coplanar_meet(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t)
{
    for (int axis = 0; axis < 3; ++axis)
        if (!Flat(axis).segment_meets(p, q, t))
            return false;
    return true;
}

/// Three points on one line have none in any projection.
bool has_area(const std::array<glm::dvec3, 3>& t)
{
    return Flat(0).turn(t[0], t[1], t[2]) != 0 || Flat(1).turn(t[0], t[1], t[2]) != 0 ||
           Flat(2).turn(t[0], t[1], t[2]) != 0;
}

/// A triangle without area is its edges: each must be in one plane with the segment to meet it.
bool meets_an_edge(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t)
{
    for (std::size_t k = 0; k < 3; ++k)
    {
        const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
        if (orientation(p, q, a, b) == 0 && coplanar_meet(p, q, {a, b, b}))
            return true;
    }
    return false;
}

/// Whether a direction parts the segment and the triangle for certain, whatever rounding does: heights along
/// it are off by less than 8 u of the sum of the products that they are made of.
bool parted_along(const glm::dvec3& d, const glm::dvec3& p, const glm::dvec3& q,
                  const std::array<glm::dvec3, 3>& t)
{
    double size = 0;
    const auto height = [&](const glm::dvec3& x) {
        const glm::dvec3 r = x - t[0];
        size = std::max(size, std::abs(d.x * r.x) + std::abs(d.y * r.y) + std::abs(d.z * r.z));
        return d.x * r.x + d.y * r.y + d.z * r.z;
    };
    const double hp = height(p), hq = height(q), h1 = height(t[1]), h2 = height(t[2]);
    const double above = std::min(hp, hq) - std::max({0.0, h1, h2});
    const double below = std::min({0.0, h1, h2}) - std::max(hp, hq);
    return std::max(above, below) > 32 * kRounding * size + kTiny;
}

/// Neighbours in a plane, of which orientations alone decide nothing, are told apart so in most cases.
bool parted(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t)
{
    const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
    for (std::size_t k = 0; k < 3; ++k)
        if (parted_along(glm::cross(t[(k + 1) % 3] - t[k], n), p, q, t))
            return true;
    return parted_along(glm::cross(q - p, n), p, q, t);
}

} // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
    const glm::dvec3 u = b - a, v = c - a, w = d - a;
    double determinant = 0, size = 0;
    for (int k = 0; k < 3; ++k)
    {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double left = u[i] * v[j], right = u[j] * v[i];
        determinant += w[k] * (left - right);
        size += std::abs(w[k]) * (std::abs(left) + std::abs(right));
    }
    // Shewchuk's bound (7 + 56 u) u of orient3d.
    if (size > kTiny && std::abs(determinant) > (7 + 56 * kRounding) * kRounding * size)
        return sign(determinant);
    return exact_orientation(a, b, c, d);
}

bool segment_meets_triangle(const glm::dvec3& p, const glm::dvec3& q, const std::array<glm::dvec3, 3>& t)
{
    if (parted(p, q, t))
        return false;
    const int at_p = orientation(t[0], t[1], t[2], p), at_q = orientation(t[0], t[1], t[2], q);
    if (at_p * at_q > 0)
        return false;
    if (at_p == 0 && at_q == 0)
        return has_area(t) ? coplanar_meet(p, q, t) : meets_an_edge(p, q, t);
    // The line through p and q meets the plane in one point, which the segment has: is it in the triangle?
    const int s0 = orientation(p, q, t[0], t[1]), s1 = orientation(p, q, t[1], t[2]),
              s2 = orientation(p, q, t[2], t[0]);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

} // namespace taut::judging
