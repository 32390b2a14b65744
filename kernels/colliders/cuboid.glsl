// Box, swept over the substep so that vertices do not tunnel.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.3 (a segment against the slabs of a box).
// Departures: the box is grown by the gap on every face, so its edges stay sharp; a vertex that starts
//   inside, or on a face, is told by the nearest face.
//
// In the frame of the box, which may move and turn, the vertex goes from `a` to `e`, taken as a straight way.
// The face by which it enters decides; if it was inside already, the face nearest to `a` does.
//! collider each_substep faces
#include "shared/turned.glsl"

#define cuboid_record CuboidCollider
#define cuboid_slide slide_of_turned
#define cuboid_way way_of_turned

/// When a coordinate comes in through the face that it moves towards, from beyond that face or from a
/// rounding behind it (where it lies at rest as often as before it); -1 = not through this pair of faces.
INLINE real time_in(real a, real v, real extent)
{
    real height = SELECT(v < real(0), a, -a) - extent;
    rbool through = v != real(0) && height >= REAL(-5e-4) * extent;
    return SELECT(through, max(height / abs(v), real(0)), real(-1));
}

/// When it leaves by the other face; -1 = it is not between them and never will be.
INLINE real time_out(real a, real v, real extent)
{
    real still = SELECT(abs(a) <= extent, REAL(1e30), real(-1));
    return SELECT(v != real(0), (SELECT(v < real(0), a, -a) + extent) / abs(v), still);
}

INLINE real largest(rvec3 v) { return max(v.x, max(v.y, v.z)); }

/// The outward normal of the face of the largest rank, on the side of `way`.
INLINE rvec3 face_of(rvec3 rank, rvec3 way)
{
    rbool x = rank.x >= rank.y && rank.x >= rank.z;
    rbool y = !x && rank.y >= rank.z;
    rvec3 side = rvec3(SELECT(way.x < real(0), real(-1), real(1)), SELECT(way.y < real(0), real(-1), real(1)),
                       SELECT(way.z < real(0), real(-1), real(1)));
    return rvec3(SELECT(x, side.x, real(0)), SELECT(y, side.y, real(0)), SELECT(x || y, real(0), side.z));
}

INLINE Contact cuboid_contact(CuboidCollider c, CuboidCollider next, rvec3 x, rvec3 d, real gap_kept)
{
    Contact met;
    rvec3 here = x - CENTRE_OF(c), there = (x - CENTRE_OF(next)) + d;
    rvec3 a = INTO_FRAME(c, here);
    rvec3 e = INTO_FRAME(next, there);
    rvec3 travel = e - a;
    rvec3 extent = rvec3(c.half_x + gap_kept, c.half_y + gap_kept, c.half_z + gap_kept);
    rvec3 way_in = rvec3(time_in(a.x, travel.x, extent.x), time_in(a.y, travel.y, extent.y),
                         time_in(a.z, travel.z, extent.z));
    real leaves = min(time_out(a.x, travel.x, extent.x),
                      min(time_out(a.y, travel.y, extent.y), time_out(a.z, travel.z, extent.z)));
    real entry = largest(way_in);
    rbool enters = entry >= real(0) && entry <= leaves && entry <= real(1);
    rvec3 height = rvec3(abs(a.x) - extent.x, abs(a.y) - extent.y, abs(a.z) - extent.z);
    rbool touches = enters || largest(height) <= real(0);
    rvec3 own = SELECT(enters, face_of(way_in, -travel), face_of(height, a));
    real reach = abs(dot(own, extent));
    met.normal = OUT_OF_FRAME(next, own);
    met.before = SELECT(touches, dot(own, a) - reach, real(0));
    met.gap = SELECT(touches, dot(own, e) - reach, real(0));
    met.motion = OUT_OF_FRAME(next, travel);
    met.friction = c.friction;
    return met;
}

#if COLLIDER_MEETS_FACES
#include "shared/face.glsl"

INLINE real smallest(rvec3 v) { return min(v.x, min(v.y, v.z)); }

INLINE rvec3 extent_for(CuboidCollider c, real gap_kept)
{
    return rvec3(c.half_x + gap_kept, c.half_y + gap_kept, c.half_z + gap_kept);
}

INLINE real cuboid_reach(CuboidCollider c, real gap_kept) { return length(extent_for(c, gap_kept)); }

INLINE bool cuboid_contains(CuboidCollider c, real gap_kept, rvec3 x)
{
    return smallest(extent_for(c, gap_kept) - abs(x)) > real(0);
}

/// How far the points between `low` and `high` would have to go along an axis of the box to be out of it;
/// none is in it where that is not above 0.
INLINE real way_out(rvec3 low, rvec3 high, rvec3 extent)
{
    return min(smallest(extent - low), smallest(extent + high));
}

INLINE real one_with_sign(real v) { return v < real(0) ? real(-1) : real(1); }

/// The corner `o` of the box, where it stands out of the triangle, which other corners may have pushed by
/// now, on the side that the middle of the box is not on: that of the normal before. Where less is needed to
/// push the corners of the triangle out, they are left to do it.
INLINE Face press_corner(Face f, rvec3 extent, rvec3 o, rvec3 normal_before, real side)
{
    rvec3 normal = unit_or_zero(cross(f.e1 - f.e0, f.e2 - f.e0)) * side;
    real height = dot(normal, f.e0 - o);
    rvec3 low = min(f.e0, min(f.e1, f.e2)), high = max(f.e0, max(f.e1, f.e2));
    if (height < real(0) && -height <= REAL(1.0625) * way_out(low, high, extent))
    {
        Closest near = closest_vertex_triangle(f.e0 - o, f.e1 - o, f.e2 - o);
        rvec3 b = weights_of(near);
        rvec3 at = abs(place_at_end(f, b));
        if (near.inside && smallest(extent * REAL(1.001) - at) >= real(0))
            f = press(f, normal, dot(normal_before, place_at_start(f, b) - o), height, b);
    }
    return f;
}

/// How an edge from `a` to `b` lies to the edges of the box along `axis`: out of the way of them is `normal`,
/// on the side of the middle where it came from, and `height` is over the one that reaches furthest there.
struct EdgeSide
{
    rvec3 normal, corner; // the middle of the box's edge
    real height;
};

INLINE EdgeSide edge_side(rvec3 axis, rvec3 a, rvec3 b, rvec3 a_before, rvec3 b_before, rvec3 extent)
{
    EdgeSide answer;
    rvec3 across = cross(b - a, axis);
    real size = length(across);
    real side = one_with_sign(dot(cross(b_before - a_before, axis), a_before));
    bool askew = size > REAL(1e-4) * length(b - a);
    answer.normal = askew ? across * (side / size) : rvec3(real(0));
    rvec3 n = answer.normal;
    rvec3 o = extent * rvec3(one_with_sign(n.x), one_with_sign(n.y), one_with_sign(n.z));
    answer.corner = o * (rvec3(real(1)) - axis);
    answer.height = askew ? dot(n, a - answer.corner) : REAL(-1e30);
    return answer;
}

/// The edge from the corner of the weights `first` to that of `second` against the edges of the box: the way
/// out across both is taken where it is the shortest of all, or as short but for rounding: of an edge that
/// lies level over a face, whose ends are beside the box, nothing else is in the way.
INLINE Face press_edge(Face f, rvec3 extent, rvec3 first, rvec3 second)
{
    rvec3 pa = place_at_start(f, first), pb = place_at_start(f, second);
    rvec3 ea = place_at_end(f, first), eb = place_at_end(f, second);
    rvec3 x = rvec3(real(1), real(0), real(0)), y = rvec3(real(0), real(1), real(0));
    rvec3 axis = rvec3(real(0), real(0), real(1));
    real least = way_out(min(ea, eb), max(ea, eb), extent);
    EdgeSide best = edge_side(axis, ea, eb, pa, pb, extent);
    EdgeSide along_x = edge_side(x, ea, eb, pa, pb, extent);
    EdgeSide along_y = edge_side(y, ea, eb, pa, pb, extent);
    if (along_x.height > best.height)
    {
        best = along_x;
        axis = x;
    }
    if (along_y.height > best.height)
    {
        best = along_y;
        axis = y;
    }
    if (best.height < real(0) && -best.height <= REAL(1.0625) * least)
    {
        rvec3 half_edge = axis * extent;
        rvec3 begin = best.corner - half_edge;
        Closest near = closest_edges(half_edge * real(2), ea - begin, eb - begin);
        if (near.inside)
        {
            rvec3 b = first * -near.weight_c + second * -near.weight_d;
            f = press(f, best.normal, dot(best.normal, place_at_start(f, b) - best.corner), best.height, b);
        }
    }
    return f;
}

/// Whether a face of the box, or the plane of the triangle, has them on different sides. What lies flat on a
/// face is a rounding inside as often as outside, and needs no more than its corners.
INLINE bool cuboid_apart(CuboidCollider c, Face f)
{
    rvec3 extent = extent_for(c, f.gap_kept);
    rvec3 low = min(f.e0, min(f.e1, f.e2)), high = max(f.e0, max(f.e1, f.e2));
    real least = REAL(2e-5) * smallest(extent);
    rvec3 across = cross(f.e1 - f.e0, f.e2 - f.e0);
    real reach = dot(abs(across), extent) - least * length(across);
    return way_out(low, high, extent) <= least || abs(dot(across, f.e0)) > reach;
}

INLINE Face cuboid_face(CuboidCollider c, Face f)
{
    rvec3 extent = extent_for(c, f.gap_kept);
    rvec3 normal_before = unit_or_zero(cross(f.p1 - f.p0, f.p2 - f.p0));
    real side = one_with_sign(dot(normal_before, f.p0));
    normal_before *= side;
    for (uint k = 0u; k < 8u; ++k)
    {
        rvec3 o = extent * rvec3((k & 1u) == 0u ? real(-1) : real(1), (k & 2u) == 0u ? real(-1) : real(1),
                                 (k & 4u) == 0u ? real(-1) : real(1));
        f = press_corner(f, extent, o, normal_before, side);
    }
    rvec3 x = rvec3(real(1), real(0), real(0)), y = rvec3(real(0), real(1), real(0));
    rvec3 z = rvec3(real(0), real(0), real(1));
    f = press_edge(f, extent, x, y);
    f = press_edge(f, extent, y, z);
    return press_edge(f, extent, z, x);
}
#endif
