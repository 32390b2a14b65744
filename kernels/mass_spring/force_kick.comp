// What forces and gravity do to velocities within a substep. One invocation per vertex; held vertices keep
// theirs. The frame of a substep adds h g on its own (predict), so gravity's share is what the integrator
// wants beyond that: semi-implicit Euler (1, 0); explicit Euler (0, -1) before the guess, (1, 1) after it;
// velocity Verlet (1/2, -1/2) before, (1/2, 1/2) after.
//
// Based on: Hairer, Lubich, Wanner. Geometric Numerical Integration, 2nd ed. 2006, I.1 (the three schemes).
// Departures: a kick beyond what float can square is not taken, and counted: an unstable run ends in a
//   status.
// Bytes per element: 48 read, 16 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
    float force_share;
    float gravity_share;
};

READ(0, rvec4, position);   // w = inverse mass, 1/kg
READ(1, rvec4, force);      // N
UPDATE(2, rvec4, velocity); // m/s
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);

KERNEL(count)
{
    real w = position[i].w;
    real h = step_values[0].substep;
    rvec3 gravity = rvec3(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z);
    real force_scale = w * (h * real(force_share));
    real gravity_scale = h * real(gravity_share);
    PRECISE rvec3 kick = rvec3(force[i]) * force_scale + gravity * gravity_scale; // drivers may factor h out
    rvec3 v = rvec3(velocity[i]) + kick;
    bool finite = abs(v.x) + abs(v.y) + abs(v.z) < REAL(1e18);
    if (w > real(0) && finite)
        velocity[i] = rvec4(v, real(0));
    if (w > real(0) && !finite)
        COUNT_EVENT(events, TAUT_EVENT_NON_FINITE);
}
