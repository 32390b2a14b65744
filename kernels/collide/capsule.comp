// Vertices against capsules, swept over the substep so that fast ones do not tunnel. One invocation per
// vertex; loops over the capsules. The functions and their sources: shared/contact.glsl.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.7 (a segment against a capsule: its ends as
//   balls, its side as a cylinder).
// Departures: none beyond those of shared/contact.glsl.
//
// In the frame of the capsule, which may move and turn, the vertex goes from `a` to `e`, taken as a straight
// way. If `e` lies inside on the side where the vertex came from, the nearest surface point decides; if the
// way enters and ends on the other side or outside again, the point of entry does.
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
UPDATE(1, rvec4, delta);           // m, w = gap kept from colliders
READ(2, CapsuleCollider, capsule); // of the start of each substep in turn, and of the end of the last
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if KEPT
UPDATE(5, rvec4, contact); // per collider and vertex: friction taken so far, w = normal push so far, m
#endif

/// From the nearest point of the axis to p.
rvec3 off_axis(rvec3 p, real half_length)
{
    return rvec3(p.x, p.y - min(max(p.y, -half_length), half_length), p.z);
}

/// When a point comes to where `outside` is 0; its square distance there, its approach and its speed squared
/// are those of time 0. 0 when it is there already, 2 = never.
real time_in(real outside, real along, real square)
{
    real discriminant = along * along - square * outside;
    real root = sqrt(max(discriminant, real(0)));
    rbool enters = discriminant > real(0) && along < real(0) && square > real(0);
    return SELECT(enters, max((-along - root) / square, real(0)), real(2));
}

/// The same for a ball of the square radius about 0.
real time_into_ball(rvec3 a, rvec3 travel, real square_radius)
{
    return time_in(dot(a, a) - square_radius, dot(a, travel), dot(travel, travel));
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
        CapsuleCollider c = capsule[substep * colliders + j];
        CapsuleCollider next = capsule[(substep + 1u) * colliders + j];
        rvec3 here = x - CENTRE_OF(c), there = (x - CENTRE_OF(next)) + d;
        rvec3 a = INTO_FRAME(c, here);
        rvec3 e = INTO_FRAME(next, there);
        rvec3 travel = e - a;
        real r = c.radius + gap_kept;
        real rr = r * r;
        rvec3 qa = off_axis(a, c.half_length), qe = off_axis(e, c.half_length);
        // A vertex at rest on the surface lies a rounding inside as often as outside; both came from there.
        rbool came_from_outside = dot(qa, qa) - rr >= REAL(-1e-3) * rr && dot(qa, travel) < real(0);
        real side = time_in((a.x * a.x + a.z * a.z) - rr, a.x * travel.x + a.z * travel.z,
                            travel.x * travel.x + travel.z * travel.z);
        side = SELECT(abs(a.y + travel.y * side) <= c.half_length, side, real(2));
        rvec3 up = rvec3(real(0), c.half_length, real(0));
        real entry = min(side, min(time_into_ball(a - up, travel, rr), time_into_ball(a + up, travel, rr)));
        rbool enters = came_from_outside && entry <= real(1);
        rbool far_side = enters && !(dot(qa, qe) > real(0) && dot(qe, qe) < rr);
        rvec3 meets = SELECT(far_side, a + travel * entry, e);
        rvec3 towards = off_axis(meets, c.half_length);
        real size = length(towards);
        // A vertex exactly on the axis leaves across it: any such direction is as good.
        rvec3 own = SELECT(size > real(0), towards / size, rvec3(real(1), real(0), real(0)));
        real gap = dot(own, e - (meets - towards)) - r;
        real push = max(allowed_gap(sqrt(dot(qa, qa)) - r, step_values[0].depenetration) - gap, real(0));
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
