// Vertices against half-spaces. One invocation per vertex; loops over the planes.
// The functions and their sources: shared/contact.glsl.
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
READ(2, PlaneCollider, plane);
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
        PlaneCollider c = plane[j];
        rvec3 n = rvec3(c.normal_x, c.normal_y, c.normal_z);
        real part = (c.offset_end - c.offset_start) / real(substeps);
        real surface = c.offset_start + part * real(substep);
        real before = (dot(n, x) - surface) - gap_kept;
        real gap = before + (dot(n, d) - part);
        real push = max(allowed_gap(before, step_values[0].depenetration) - gap, real(0));
        if (report != 0u)
            COUNT_EVENT_IF(!moves && push > real(0), events, TAUT_EVENT_CONFLICT);
        push = SELECT(moves, push, real(0));
        d += n * push;
#if FRICTION
        rvec3 slide = (d - n * dot(n, d));
        rvec3 shift = rvec3(c.shift_x, c.shift_y, c.shift_z) / real(substeps);
        slide -= shift - n * dot(n, shift);
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
