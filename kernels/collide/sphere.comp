// Vertices against balls, swept over the substep so that fast ones do not tunnel. One invocation per
// vertex; loops over the balls. The functions and their sources: shared/contact.glsl.
//
// In the frame of the ball the vertex moves on the segment from `a` to `e`. If `e` lies inside on the side
// where the vertex came from, the nearest surface point decides; if the segment enters and ends on the
// other side or outside again, the point of entry does.
// Bytes per element: 32 read, 16 written (float); friction_kept 16 more each way per collider.
//! lanes
//! variant friction FRICTION=1
//! variant friction_kept FRICTION=1 KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact.glsl"

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
UPDATE(1, rvec4, delta); // m, w = gap kept from colliders
READ(2, SphereCollider, sphere);
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if KEPT
UPDATE(5, rvec4, contact); // per collider and vertex: friction taken so far, w = normal push so far, m
#endif

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
        SphereCollider c = sphere[j];
        rvec3 from = rvec3(c.start_x, c.start_y, c.start_z);
        rvec3 shift = (rvec3(c.end_x, c.end_y, c.end_z) - from) / real(substeps);
        real r = c.radius + gap_kept;
        rvec3 a = x - (from + shift * real(substep));
        rvec3 travel = d - shift;
        rvec3 e = a + travel;
        real outside = dot(a, a) - r * r;
        real along = dot(a, travel);
        real square = dot(travel, travel);
        real discriminant = along * along - square * outside;
        real root = sqrt(max(discriminant, real(0)));
        real entry = SELECT(square > real(0), max((-along - root) / square, real(0)), real(2));
        // A vertex at rest on the surface lies a rounding inside as often as outside; both came from there.
        rbool came_from_outside = outside >= REAL(-1e-3) * r * r && along < real(0);
        rbool enters = came_from_outside && discriminant > real(0) && entry <= real(1);
        rbool far_side = enters && !(dot(a, e) > real(0) && dot(e, e) < r * r);
        rvec3 towards = SELECT(far_side, a + travel * entry, e);
        real size = length(towards);
        // A vertex exactly at the centre leaves upwards: any direction is as good.
        rvec3 n = SELECT(size > real(0), towards / size, rvec3(real(0), real(1), real(0)));
        real gap = dot(n, e) - r;
        real push = max(allowed_gap(sqrt(dot(a, a)) - r, step_values[0].depenetration) - gap, real(0));
        if (report != 0u)
            COUNT_EVENT_IF(!moves && push > real(0), events, TAUT_EVENT_CONFLICT);
        push = SELECT(moves, push, real(0));
        d += n * push;
#if FRICTION
        rvec3 slide = d - shift;
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
