// Vertices against colliders of one shape: pushed out, and held back by friction. One invocation per vertex;
// loops over the colliders.
//
// Based on: shared/contact.glsl, and the shape's own file for what a vertex meets.
// Departures: none beyond those of the two.
// Bytes per element: 32 read, 16 written (float); friction_kept 16 more each way per collider.
//! each collider
//! lanes
//! variant friction FRICTION=1
//! variant friction_kept FRICTION=1 KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact.glsl"
#if COLLIDER_VALUES
#define KEPT_SLOT 6
READ(5, real, values); // of all colliders of the shape, one after the other
#else
#define KEPT_SLOT 5
#endif
#include TAUT_COLLIDER

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
READ(2, OF_COLLIDER(record), collider);
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if KEPT
UPDATE(KEPT_SLOT, rvec4, contact); // per collider and vertex: friction so far, w = normal push so far, m
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
#if COLLIDER_POSES
        OF_COLLIDER(record) c = collider[substep * colliders + j];
        OF_COLLIDER(record) next = collider[(substep + 1u) * colliders + j];
        Contact met = OF_COLLIDER(contact)(c, next, x, d, gap_kept);
#else
        OF_COLLIDER(record) c = collider[j];
        Contact met = OF_COLLIDER(contact)(c, real(substep), real(substeps), x, d, gap_kept);
#endif
        real way = way_out(met.before, step_values[0].depenetration, step_values[0].braked);
        real push = max(allowed_gap(met.before, way) - met.gap, real(0));
        if (report != 0u)
            COUNT_EVENT_IF(!moves && push > real(0), events, TAUT_EVENT_CONFLICT);
        push = SELECT(moves, push, real(0));
        d += met.normal * push;
#if FRICTION
        rvec3 slide = OF_COLLIDER(slide)(met, d);
#if KEPT
        rvec4 taken = first_iteration != 0u ? rvec4(real(0)) : contact[j * count + i];
#else
        rvec4 taken = rvec4(real(0));
#endif
        rvec4 now = friction_taken(taken, slide, push, met.friction);
        d -= rvec3(now - taken);
#if KEPT
        contact[j * count + i] = now;
#endif
#endif
    }
    delta[i] = SELECT(moves, rvec4(d, gap_kept), guess);
}
