// Forces of springs, gathered: one invocation per vertex adds the forces of the springs that end there, in
// the order of the springs. Each spring is evaluated twice; nothing is written twice.
//
// Based on: Va, Choi, Hong. Real-Time Cloth Simulation Using Compute Shader in Unity3D for AR/VR Contents.
//   Applied Sciences 11(17), 2021, algorithm 1 (node-centric).
// Departures: the ends at a vertex are listed, so any mesh or network will do, not a grid of 12 neighbours.
// Bytes per vertex: 24 read, 16 written; per spring end 24 + 32, damped 16 more (float).
//! variant damped DAMPED=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/spring.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count springs without a direction
};

READ(0, uint, start);     // count + 1: the ends at vertex i are end[start[i]] .. end[start[i + 1] - 1]
READ(1, Spring, end);     // a = this vertex, b = the other
READ(2, rvec4, position); // m
READ(3, rvec4, low);      // m, what position lost to rounding
WRITE(4, rvec4, force);   // N
COUNTERS(5, events);
#if DAMPED
READ(6, rvec4, velocity); // m/s
#endif

KERNEL(count)
{
    rvec4 x = position[i];
    rvec4 rest = low[i];
#if DAMPED
    rvec4 v = velocity[i];
#endif
    rvec3 sum = rvec3(real(0));
    for (uint k = start[i]; k < start[i + 1u]; ++k)
    {
        Spring s = end[k];
        rvec4 far = position[s.b];
        rvec3 d = rvec3(x - far) + rvec3(rest - low[s.b]);
#if DAMPED
        rvec3 speed = rvec3(v - velocity[s.b]);
#else
        rvec3 speed = rvec3(real(0));
#endif
        sum += spring_force(s.rest_length, s.stiffness, s.damping, d, speed);
        if (report != 0u)
        {
            // Each spring is met at both ends; the lower one counts it.
            if (i < s.b && !spring_has_direction(d) && s.rest_length > real(0) && x.w + far.w > real(0))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    force[i] = rvec4(sum, real(0));
}
