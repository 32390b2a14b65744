// Inertial guess of a substep: displacement from velocity and gravity. One invocation per vertex.
//
// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1, line "predict".
// Departures: the result is a displacement that also carries what the position lost to rounding
//   (`low`), so constraints see the full position; speeds beyond max_speed are clamped and counted.
// Bytes per element: 48 read, 16 written (float).
//! lanes
//! variant kept KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, rvec4, position); // w = inverse mass; 0 holds the vertex
READ(1, rvec4, low);      // w = gap kept from colliders, m; carried on in delta.w
READ(2, rvec4, velocity); // m/s
WRITE(3, rvec4, delta);   // m
READ_ONE(4, StepValues, step_values);
COUNTERS(5, events);
#if KEPT
WRITE(6, rvec4, predicted); // the guess itself, for the primal residual
#endif

KERNEL(count)
{
    real h = step_values[0].substep;
    real limit = step_values[0].max_speed;
    rbool moves = position[i].w > real(0);
    rvec4 v = velocity[i];
    v += rvec4(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z, real(0)) * h;
    real speed = length(rvec3(v));
    rbool fast = moves && speed > limit;
    if (ANY(fast))
    {
        v = SELECT(fast, v * (limit / speed), v);
        COUNT_EVENT_IF(fast, events, TAUT_EVENT_SPEED_CLAMP);
    }
    v.w = real(0); // behind the clamp, whose factor may be no number
    rvec4 rest = low[i];
    rvec4 guess = SELECT(moves, v * h + rest, rest);
    delta[i] = guess;
#if KEPT
    predicted[i] = guess;
#endif
}
