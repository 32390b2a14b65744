// Elements against colliders.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.1.5 (point, triangle), 5.1.9 (two segments),
//   5.2.9 (triangle and box by separating axes); Provot. Collision and self-collision handling in cloth
//   model dedicated to design garments. 1997 (a moving point is in the plane of a moving triangle at the
//   roots of a cubic; the same of two edges, of which one is at rest here).
// Departures: the depth in a box is the amount by which the box may shrink before the element leaves it,
//   found by halving.

#include "taut/report/crossing_shapes.hpp"

#include "taut/scene/distance_field.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double kRim = 1.5; ///< of an edge: how far from a thin box' rim elements may cut through it

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    return glm::dot(a, glm::cross(b, c));
}

double point_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - t * along);
}

/// Whether the foot of p in the plane of the triangle lies within it.
bool above(const glm::dvec3& p, const TriangleCorners& t, double slack)
{
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double square = glm::dot(normal, normal);
    if (!(square > 0))
        return false;
    for (int k = 0; k < 3; ++k)
    {
        const glm::dvec3& a = t[static_cast<std::size_t>(k)];
        const glm::dvec3& b = t[static_cast<std::size_t>((k + 1) % 3)];
        if (determinant(b - a, p - a, normal) < -slack * square)
            return false;
    }
    return true;
}

double point_triangle(const glm::dvec3& p, const TriangleCorners& t)
{
    if (above(p, t, 0))
    {
        const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
        return std::abs(glm::dot(p - t[0], normal));
    }
    return std::min(
        {point_segment(p, t[0], t[1]), point_segment(p, t[1], t[2]), point_segment(p, t[2], t[0])});
}

double two_segments(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d)
{
    const glm::dvec3 u = b - a, v = d - c, r = a - c;
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double square = uu * vv - uv * uv;
    if (square > 1e-14 * uu * vv)
    {
        const double s = (uv * glm::dot(v, r) - vv * glm::dot(u, r)) / square;
        const double t = (uu * glm::dot(v, r) - uv * glm::dot(u, r)) / square;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
            return glm::length(r + s * u - t * v);
    }
    return std::min(
        {point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b), point_segment(d, a, b)});
}

/// Of the segment from -half to +half.
double axis_triangle(const glm::dvec3& half, const TriangleCorners& t)
{
    if (half == glm::dvec3(0))
        return point_triangle(half, t);
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double low = glm::dot(-half - t[0], normal), high = glm::dot(half - t[0], normal);
    if (low * high < 0 && above(-half + low / (low - high) * 2.0 * half, t, 0))
        return 0;
    double nearest = std::min(point_triangle(-half, t), point_triangle(half, t));
    for (std::size_t k = 0; k < 3; ++k)
        nearest = std::min(nearest, two_segments(-half, half, t[k], t[(k + 1) % 3]));
    return nearest;
}

/// Whether an axis has the element and the box on different sides.
bool separates(const glm::dvec3& axis, const glm::dvec3& half, const TriangleCorners& t)
{
    const double p[] = {glm::dot(axis, t[0]), glm::dot(axis, t[1]), glm::dot(axis, t[2])};
    const double reach = glm::dot(glm::abs(axis), half);
    return std::min({p[0], p[1], p[2]}) > reach || std::max({p[0], p[1], p[2]}) < -reach;
}

bool meets_box(const glm::dvec3& half, const TriangleCorners& t)
{
    const glm::dvec3 edges[] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    if (separates(glm::cross(edges[0], edges[1]), half, t))
        return false;
    for (int k = 0; k < 3; ++k)
    {
        glm::dvec3 unit(0);
        unit[k] = 1;
        if (separates(unit, half, t))
            return false;
        for (const glm::dvec3& edge : edges)
            if (separates(glm::cross(unit, edge), half, t))
                return false;
    }
    return true;
}

/// f(t) = c0 + c1 t + c2 t^2 + c3 t^3
double cubic(const std::array<double, 4>& c, double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }

/// The root between two places where the signs differ.
double halve(const std::array<double, 4>& c, double low, double high)
{
    const bool rises = cubic(c, low) < 0;
    for (int i = 0; i < 60; ++i)
    {
        const double middle = 0.5 * (low + high);
        ((cubic(c, middle) < 0) == rises ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Roots in (0, 1], ascending. Where the slope changes sign the interval is cut, so that no two of them hide.
std::vector<double> roots(const std::array<double, 4>& c)
{
    std::vector<double> cuts{0, 1}, found;
    const double a = 3 * c[3], b = 2 * c[2], square = b * b - 4 * a * c[1];
    if (square >= 0)
    {
        const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
        for (const double t : {a != 0 ? q / a : -1.0, q != 0 ? c[1] / q : -1.0})
            if (t > 0 && t < 1)
                cuts.push_back(t);
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
        const double low = cubic(c, cuts[k]), high = cubic(c, cuts[k + 1]);
        if (low != 0 && high == 0)
            found.push_back(cuts[k + 1]);
        else if ((low < 0) != (high < 0) && low != 0)
            found.push_back(halve(c, cuts[k], cuts[k + 1]));
    }
    return found;
}

/// Whether the segment from `a` to `b` and that from -reach to +reach, neither of them along the other, meet
/// where they are in one plane.
bool segments_meet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& reach)
{
    const glm::dvec3 along = b - a, normal = glm::cross(along, reach);
    const double square = glm::dot(normal, normal);
    if (!(square > 1e-18 * glm::dot(along, along) * glm::dot(reach, reach)))
        return false;
    const double s = -determinant(a, reach, normal) / square;      // a + s along
    const double t = -determinant(a, along, normal) / square;      // t reach
    return s >= -1e-9 && s <= 1 + 1e-9 && std::abs(t) <= 1 + 1e-9; // at an end is on it
}

/// Whether a moving link goes through the segment from -reach to +reach.
bool crosses(const glm::dvec3& reach, const TriangleCorners& before, const TriangleCorners& after)
{
    // The determinant of (b - a, reach, -a), of which the first and the last are linear in time.
    const glm::dvec3 u = before[1] - before[0], du = (after[1] - after[0]) - u;
    const glm::dvec3 q = -before[0], dq = before[0] - after[0];
    const std::array<double, 4> c{determinant(u, reach, q),
                                  determinant(du, reach, q) + determinant(u, reach, dq),
                                  determinant(du, reach, dq), 0};
    const std::vector<double> times = roots(c);
    return std::any_of(times.begin(), times.end(), [&](double t) {
        return segments_meet((1 - t) * before[0] + t * after[0], (1 - t) * before[1] + t * after[1], reach);
    });
}

/// Whether a point on its way goes through the middle plane of a plate, within `half` of its centre.
bool pierces(const glm::dvec3& half, int normal, const glm::dvec3& before, const glm::dvec3& after)
{
    if (before[normal] == 0 || (before[normal] < 0) == (after[normal] < 0))
        return false;
    const double t = before[normal] / (before[normal] - after[normal]);
    for (int k = 0; k < 3; ++k)
        if (k != normal && std::abs((1 - t) * before[k] + t * after[k]) >= half[k])
            return false;
    return true;
}

double across_box(const glm::dvec3& half, const glm::dvec3& way)
{
    const glm::dvec3 across = glm::sqrt(glm::max(1.0 - way * way, 0.0)) * half;
    return std::max({across.x, across.y, across.z});
}

/// Whether a link goes through what stands for a ball of half size `size`: the disc that it comes upon flat.
bool link_goes_through_ball(double size, const TriangleCorners& before, const TriangleCorners& after)
{
    const glm::dvec3 along = before[1] - before[0] + after[1] - after[0];
    const glm::dvec3 across = glm::cross(along, after[0] - before[0] + after[1] - before[1]);
    const double length = glm::length(across);
    return length > 0 && crosses(0.5 * size / length * across, before, after);
}

/// Half sizes less what is near a rim: of a box, by as much as its thinnest or 1.5 edges.
glm::dvec3 inner_half(const SolidShape& shape, double edge)
{
    const double margin = shape.radius > 0 ? 0 : std::max(shape.size, kRim * edge);
    return glm::max(shape.half - margin, glm::dvec3(0));
}

} // namespace

SolidShape solid_shape(const Collider& collider)
{
    const ColliderSolid solid = solid_of(collider);
    SolidShape out;
    out.half = solid.half;
    out.radius = solid.radius;
    out.size = solid.is_box() ? std::min({out.half.x, out.half.y, out.half.z}) : solid.radius;
    if (solid.field)
    {
        out.size = solid.field->depth();
        out.deep = deep_points(*solid.field);
    }
    out.solid = solid;
    out.reach = glm::length(out.half) + out.radius;
    return out;
}

double width_across(const SolidShape& shape, const glm::dvec3& way)
{
    if (!shape.solid.field)
        return shape.radius + across_box(shape.half, way);
    double width = glm::length(shape.half);
    for (const DeepPoint& p : shape.deep)
        width = std::min(width, across_box(p.half, way));
    return width;
}

double depth_of(const SolidShape& shape, const TriangleCorners& element)
{
    if (shape.solid.field)
        return depth_in_field(*shape.solid.field, element);
    if (shape.radius > 0)
        return std::max(shape.radius - axis_triangle(shape.half, element), 0.0);
    if (!meets_box(shape.half, element))
        return 0;
    double low = 0, high = shape.size;
    while (high - low > 1e-6 * shape.size)
    {
        const double middle = 0.5 * (low + high);
        (meets_box(shape.half - middle, element) ? low : high) = middle;
    }
    return low;
}

bool lies_deep(const SolidShape& shape, const TriangleCorners& element, double edge)
{
    if (shape.solid.field)
        return lies_deep_in_field(*shape.solid.field, shape.deep, element);
    if (shape.radius > 0)
        return shape.radius - axis_triangle(shape.half, element) > 0.5 * shape.radius;
    glm::dvec3 half(0);
    for (int k = 0; k < 3; ++k)
    {
        const bool thin = shape.half[k] <= shape.size;
        const double margin = thin ? 0.5 * shape.size : std::max(0.5 * shape.size, kRim * edge);
        half[k] = std::max(shape.half[k] - margin, 0.0);
    }
    return meets_box(half, element);
}

std::vector<glm::dvec3> middle_points(const SolidShape& shape, double edge)
{
    if (shape.solid.field)
    {
        std::vector<glm::dvec3> places;
        for (const DeepPoint& p : shape.deep)
            places.push_back(p.place);
        return places;
    }
    constexpr int kMost = 32; // along one axis
    const glm::dvec3 half = inner_half(shape, edge);
    glm::ivec3 steps(0); // to either side
    for (int k = 0; k < 3; ++k)
    {
        const double wanted = std::ceil(half[k] / shape.size);
        steps[k] = static_cast<int>(std::min<double>(wanted, shape.radius > 0 ? kMost : 4));
    }
    std::vector<glm::dvec3> points;
    for (int x = -steps.x; x <= steps.x; ++x)
        for (int y = -steps.y; y <= steps.y; ++y)
            for (int z = -steps.z; z <= steps.z; ++z)
                points.push_back(half * glm::dvec3(x, y, z) / glm::dvec3(glm::max(steps, 1)));
    return points;
}

bool goes_through(const glm::dvec3& point, const TriangleCorners& before, const TriangleCorners& after)
{
    // The determinant of (b - a, c - a, point - a), each of which is linear in time.
    const glm::dvec3 u = before[1] - before[0], du = (after[1] - after[0]) - u;
    const glm::dvec3 w = before[2] - before[0], dw = (after[2] - after[0]) - w;
    const glm::dvec3 q = point - before[0], dq = (point - after[0]) - q;
    const std::array<double, 4> c{
        determinant(u, w, q), determinant(du, w, q) + determinant(u, dw, q) + determinant(u, w, dq),
        determinant(du, dw, q) + determinant(du, w, dq) + determinant(u, dw, dq), determinant(du, dw, dq)};
    for (const double t : roots(c))
    {
        TriangleCorners then;
        for (std::size_t k = 0; k < 3; ++k)
            then[k] = (1 - t) * before[k] + t * after[k];
        if (above(point, then, 1e-9)) // through an edge is through
            return true;
    }
    return false;
}

bool link_goes_through(const SolidShape& shape, double edge, const TriangleCorners& before,
                       const TriangleCorners& after)
{
    const auto from = [](TriangleCorners t, const glm::dvec3& origin) {
        for (glm::dvec3& corner : t)
            corner -= origin;
        return t;
    };
    if (shape.solid.field)
        return std::any_of(shape.deep.begin(), shape.deep.end(), [&](const DeepPoint& p) {
            return link_goes_through_ball(p.depth, from(before, p.place), from(after, p.place));
        });
    const glm::dvec3 half = inner_half(shape, edge);
    if (half == glm::dvec3(0))
        return link_goes_through_ball(shape.size, before, after);
    int thinnest = 0;
    for (int k = 0; k < 3; ++k)
    {
        glm::dvec3 reach(0);
        reach[k] = half[k];
        if (half[k] > 0 && crosses(reach, before, after))
            return true;
        thinnest = shape.half[k] < shape.half[thinnest] ? k : thinnest;
    }
    return pierces(half, thinnest, before[0], after[0]) || pierces(half, thinnest, before[1], after[1]);
}

bool comes_near(const SolidShape& shape, const TriangleCorners& triangle, double way)
{
    if (shape.solid.field)
        return false;
    if (shape.radius > 0)
        return axis_triangle(shape.half, triangle) <= shape.radius + way;
    return meets_box(shape.half + way, triangle);
}

} // namespace taut
