#pragma once
// Elements of a mesh against the inside of colliders, of which the methods know only the vertices. Pure
// functions in fp64; all points are in the frame of the collider, m.

#include "taut/report/field_middle.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/faces.hpp"

#include <array>
#include <vector>

namespace taut {

/// A triangle, or a link as one whose last two corners coincide.
using TriangleCorners = std::array<glm::dvec3, 3>;

/// A ball is a point, a capsule a segment along y, both with a radius round them; a box has no radius. A
/// distance field is what it says: `half` is that of its grid.
struct SolidShape
{
    glm::dvec3 half{0};
    double radius = 0;
    double size = 0;  ///< the smallest of the three half sizes; of a field how deep its deepest point lies
    double reach = 0; ///< from the centre to the furthest point
    ColliderSolid solid;         ///< of a field: to be used while the collider has it
    std::vector<DeepPoint> deep; ///< of a field
};

/// Of anything but a plane, which has no inside that an element between vertices outside could reach.
SolidShape solid_shape(const Collider& collider);

/// Half of what has to fit through a hole when it moves along `way` (a unit vector; 0: whichever is widest).
double width_across(const SolidShape& shape, const glm::dvec3& way);

/// Of the deepest point of an element below the surface; 0 of one that is outside. Of a box: to 1e-6 of its
/// smallest half size; of a field: of 45 points of the element.
double depth_of(const SolidShape& shape, const TriangleCorners& element);

/// Whether an element lies deeper than half the smallest half size. With its vertices outside, that takes an
/// edge longer than 1.5 radii of a ball or a capsule, 1.4 half sizes of a cube. A box may be thinner than
/// the cloth's edges, which then cut through it where cloth is laid over its rim: within 1.5 `edge` of a
/// rim nothing counts. Of a field half of how deep the nearest deep point lies. `edge`: the longest of the
/// body at rest, m.
bool lies_deep(const SolidShape& shape, const TriangleCorners& element, double edge);

/// Points in the middle of a collider, closer to each other than its size: centre, axis, or middle plane
/// less 1.5 `edge` at the rim.
std::vector<glm::dvec3> middle_points(const SolidShape& shape, double edge);

/// Whether `point` goes through an element whose corners move in straight lines from `before` to `after`.
/// One that the point lies on at the start and leaves does not count. Links are never gone through.
bool goes_through(const glm::dvec3& point, const TriangleCorners& before, const TriangleCorners& after);

/// Whether a link that moves likewise goes through the middle of a collider, its axis. One that is a point,
/// of a ball or a cube, is as good as the disc of half its size that the link comes upon flat; through the
/// middle plane of a plate an end has to go. Axis and plane of a box end 1.5 `edge` before its rim. A field
/// is as a ball at each of its deep points.
bool link_goes_through(const SolidShape& shape, double edge, const TriangleCorners& before,
                       const TriangleCorners& after);

/// Whether a triangle comes within `way` (m, >= 0) of a shape, or into it. Of a box: into the box grown by it
/// on every face; a field: never.
bool comes_near(const SolidShape& shape, const TriangleCorners& triangle, double way);

} // namespace taut
