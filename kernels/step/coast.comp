// Where gravity alone would take each vertex in a substep, from the velocity that the one before left: what
// forces do in the substep shows against it. Runs before they act. One invocation per vertex.
//
// Based on: Hairer, Lubich, Wanner. Geometric Numerical Integration, 2nd ed. 2006, I.1.4 (leapfrog: a
//   velocity at a step is the one before it and half the kick that follows).
// Departures: the kick is taken from the last substep, so that nothing is evaluated twice.
// Bytes per element: 48 read, 16 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, rvec4, position);  // w = inverse mass; 0 holds the vertex
READ(1, rvec4, low);       // m; what a vertex that stays where it is is displaced by
READ(2, rvec4, velocity);  // m/s
WRITE(3, rvec4, coasting); // m
READ_ONE(4, StepValues, step_values);

KERNEL(count)
{
    real h = step_values[0].substep;
    rvec4 v = velocity[i];
    v += rvec4(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z, real(0)) * h;
    v.w = real(0);
    rvec4 rest = low[i];
    coasting[i] = SELECT(position[i].w > real(0), v * h + rest, rest);
}
