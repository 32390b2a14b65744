// Box, swept over the substep so that vertices do not tunnel.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.3 (a segment against the slabs of a box).
// Departures: the box is grown by the gap on every face, so its edges stay sharp; a vertex that starts
//   inside, or on a face, is told by the nearest face.
//
// In the frame of the box, which may move and turn, the vertex goes from `a` to `e`, taken as a straight way.
// The face by which it enters decides; if it was inside already, the face nearest to `a` does.
//! collider each_substep
#include "shared/turned.glsl"

#define cuboid_record CuboidCollider
#define cuboid_slide slide_of_turned

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
