// PBD of elements of two corners at one vertex that has very many: solved at once by one group, with the
// hub's mass split among them, so that a star of 10,000 springs is one dispatch and not 10,000 colours.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012: each constraint sees the hub with 1/n of its mass; the copies are then averaged.
// Departures: none. The sum over the constraints is a fixed tree, so the result does not vary.
// Bytes per constraint: 16 + 32 read, 16 written (float), besides the hub itself.
//! each element of pbd_hub
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"
#include TAUT_ELEMENT

PARAMS
{
    uint first;
    uint count;  // elements at the hub; the hub is corner 0 of each
    float share; // of a correction that one iteration makes
    uint report; // 1: count elements without a gradient
};

READ(0, OF_ELEMENT(record), constraint); // its compliance is not read
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
        OF_ELEMENT(record) c = constraint[k];
        rvec4 x0 = position[OF_ELEMENT(v0)(c)];
        rvec4 x1 = position[OF_ELEMENT(v1)(c)];
        rvec4 d1 = delta[OF_ELEMENT(v1)(c)];
        rvec3 e1 = rvec3((x1 - x0) + (d1 - delta[OF_ELEMENT(v0)(c)]));
        ElementRow row = OF_ELEMENT(row)(c, e1);
        RowPush push = row_push(row, row_weight(row, x0.w * real(count), x1.w), real(share));
        rvec3 p0 = row.g0 * push.scale;
        delta[OF_ELEMENT(v1)(c)] = d1 - rvec4(p0 * x1.w, real(0));
        sum += p0 * x0.w; // the mean of the copies' moves
        if (report != 0u && !push.usable && row.counted && ELEMENT_MASS > real(0))
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
        uint hub = OF_ELEMENT(v0)(constraint[first]);
        delta[hub] = delta[hub] + partial[0];
    }
    PHASE_END
}
