// PBD distance constraints of one vertex that has very many: solved at once by one group, with the hub's mass
// split among them, so that a star of 10,000 springs is one dispatch and not 10,000 colours.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012: each constraint sees the hub with 1/n of its mass; the copies are then averaged.
// Departures: none. The sum over the constraints is a fixed tree, so the result does not vary.
// Bytes per constraint: 16 + 32 read, 16 written (float), besides the hub itself.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"

PARAMS
{
    uint first;
    uint count;  // constraints at the hub; the hub is end `a` of each
    float share; // of a correction that one iteration makes
    uint report; // 1: count degenerate constraints
};

READ(0, DistanceConstraint, constraint); // its compliance is not read
READ(1, rvec4, position);                // xyz m, w = inverse mass 1/kg
UPDATE(2, rvec4, delta);                 // displacement since the start of the substep, m
COUNTERS(3, events);

SHARED(rvec4, partial, 64);

GROUP_KERNEL(64)
{
    PHASE_BEGIN
    rvec3 sum = rvec3(real(0));
    for (uint k = first + lane; k < first + count; k += 64u)
    {
        DistanceConstraint c = constraint[k];
        rvec4 hub = position[c.a];
        rvec4 xb = position[c.b];
        rvec4 db = delta[c.b];
        rvec4 copy = rvec4(rvec3(hub), hub.w * real(count));
        SpringPush wanted = spring_push(c, copy, xb, delta[c.a], db, real(share));
        delta[c.b] = db - wanted.push * xb.w;
        sum += rvec3(wanted.push) * hub.w; // the mean of the copies' moves
        if (report != 0u && !wanted.usable && hub.w + xb.w > real(0) && c.rest_length > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
    partial[lane] = rvec4(sum, real(0));
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        PHASE_BEGIN
        if (lane < width)
            partial[lane] += partial[lane + width];
        PHASE_END
    }
    PHASE_BEGIN
    if (lane == 0u)
    {
        uint hub = constraint[first].a;
        delta[hub] = delta[hub] + partial[0];
    }
    PHASE_END
}
