// Vertices against boxes, swept over the substep so that fast ones do not tunnel. One invocation per vertex;
// loops over the boxes. The functions and their sources: shared/contact.glsl.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.3 (a segment against the slabs of a box).
// Departures: the box is grown by the gap on every face, so its edges stay sharp; a vertex that starts
//   inside, or on a face, is told by the nearest face.
//
// In the frame of the box, which may move and turn, the vertex goes from `a` to `e`, taken as a straight way.
// The face by which it enters decides; if it was inside already, the face nearest to `a` does.
// Bytes per element: 32 read, 16 written (float); friction_kept 16 more each way per collider.
//! lanes
//! variant friction FRICTION=1
//! variant friction_kept FRICTION=1 KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact.glsl"
#include "shared/turned.glsl"

PARAMS
{
    uint count;
    uint colliders;
    uint substep;
    uint substeps;
    uint first_iteration;
    uint report; // 1: count held vertices below a surface
};

READ(0, rvec4, position);
UPDATE(1, rvec4, delta);         // m, w = gap kept from colliders
READ(2, CuboidCollider, cuboid); // of the start of each substep in turn, and of the end of the last
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if KEPT
UPDATE(5, rvec4, contact); // per collider and vertex: friction taken so far, w = normal push so far, m
#endif

/// When a coordinate comes in through the face that it moves towards, from beyond that face or from a
/// rounding behind it (where it lies at rest as often as before it); -1 = not through this pair of faces.
real time_in(real a, real v, real extent)
{
    real height = SELECT(v < real(0), a, -a) - extent;
    rbool through = v != real(0) && height >= REAL(-5e-4) * extent;
    return SELECT(through, max(height / abs(v), real(0)), real(-1));
}

/// When it leaves by the other face; -1 = it is not between them and never will be.
real time_out(real a, real v, real extent)
{
    real still = SELECT(abs(a) <= extent, REAL(1e30), real(-1));
    return SELECT(v != real(0), (SELECT(v < real(0), a, -a) + extent) / abs(v), still);
}

real largest(rvec3 v) { return max(v.x, max(v.y, v.z)); }

/// The outward normal of the face of the largest rank, on the side of `way`.
rvec3 face_of(rvec3 rank, rvec3 way)
{
    rbool x = rank.x >= rank.y && rank.x >= rank.z;
    rbool y = !x && rank.y >= rank.z;
    rvec3 side = rvec3(SELECT(way.x < real(0), real(-1), real(1)), SELECT(way.y < real(0), real(-1), real(1)),
                       SELECT(way.z < real(0), real(-1), real(1)));
    return rvec3(SELECT(x, side.x, real(0)), SELECT(y, side.y, real(0)), SELECT(x || y, real(0), side.z));
}

KERNEL(count)
{
    rvec4 p = position[i];
    rvec3 x = rvec3(p);
    rvec4 guess = delta[i];
    rvec3 d = rvec3(guess);
    real gap_kept = guess.w;
    rbool moves = p.w > real(0);
    for (uint j = 0u; j < colliders; ++j)
    {
        CuboidCollider c = cuboid[substep * colliders + j];
        CuboidCollider next = cuboid[(substep + 1u) * colliders + j];
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
        real gap = dot(own, e) - reach;
        real push = max(allowed_gap(dot(own, a) - reach, step_values[0].depenetration) - gap, real(0));
        push = SELECT(touches, push, real(0));
        if (report != 0u)
            COUNT_EVENT_IF(!moves && push > real(0), events, TAUT_EVENT_CONFLICT);
        push = SELECT(moves, push, real(0));
        rvec3 n = OUT_OF_FRAME(next, own);
        d += n * push;
#if FRICTION
        rvec3 slide = OUT_OF_FRAME(next, travel);
        slide -= n * dot(n, slide);
#if KEPT
        rvec4 taken = first_iteration != 0u ? rvec4(real(0)) : contact[j * count + i];
#else
        rvec4 taken = rvec4(real(0));
#endif
        rvec4 now = friction_taken(taken, slide, push, c.friction);
        d -= rvec3(now - taken);
#if KEPT
        contact[j * count + i] = now;
#endif
#endif
    }
    delta[i] = SELECT(moves, rvec4(d, gap_kept), guess);
}
