// End of a substep: velocity from the displacement, displacement into the position. One invocation per
// vertex.
//
// Based on:
//   Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1, lines "update".
//   Dekker. A floating-point technique for extending the available precision. 1971: the two-sum, without
//   which a substep of less than an ulp of the position would be lost.
// Departures: a displacement that is not finite is dropped and counted; the vertex keeps its last
//   finite place; the velocity is a quotient, because a product with a rounded 1/h would change every
//   velocity by the same factor in every substep (2e-8 at h = 1/600 s: 1e-5 of the momentum in a second).
// Bytes per element: 48 read, 64 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

UPDATE(0, rvec4, position); // xyz m, w = inverse mass
UPDATE(1, rvec4, low);      // m, w = gap kept from colliders
WRITE(2, rvec4, velocity);  // m/s
UPDATE(3, rvec4, delta);    // m
READ_ONE(4, StepValues, step_values);
COUNTERS(5, events);

KERNEL(count)
{
    rvec4 p = position[i];
    rvec3 x = rvec3(p);
    rvec4 kept = low[i];
    rvec3 lost = rvec3(kept);
    rvec4 moved = delta[i];
    rvec3 d = rvec3(moved);
    real size = abs(d.x) + abs(d.y) + abs(d.z) + abs(x.x) + abs(x.y) + abs(x.z);
    rbool finite = size < REAL(1e18); // squares of coordinates must stay finite in float
    d = SELECT(finite, d, lost);

    PRECISE rvec3 sum = x + d;
    PRECISE rvec3 part = sum - x;
    PRECISE rvec3 error = (x - (sum - part)) + (d - part);
    position[i] = rvec4(sum, p.w);
    low[i] = rvec4(error, kept.w);
    velocity[i] = rvec4(SELECT(finite, (d - lost) / step_values[0].substep, rvec3(real(0))), real(0));
    if (ANY(!finite))
    {
        delta[i] = SELECT(finite, moved, kept);
        COUNT_EVENT_IF(!finite, events, TAUT_EVENT_NON_FINITE);
    }
}
