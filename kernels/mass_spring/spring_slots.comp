// Forces of springs, one invocation per spring: the force on its end `a` goes to the spring's own slot. The
// pass `slot_sum` adds up what ends at each vertex, with the sign of the end.
//
// Based on: spring kernels of github.com/nakjun/Multi-Deformable-Objects-Simulation: slots for the
//   forces of springs, a second pass that sums them.
// Departures: one slot a spring, not one an end, because the two forces are opposite to the last bit; any
//   number of springs at a vertex.
// Bytes per spring: 24 + 64 read, damped 32 more, 16 written (float).
//! variant damped DAMPED=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/spring.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count springs without a direction
};

READ(0, Spring, spring);
READ(1, rvec4, position); // m
READ(2, rvec4, low);      // m
WRITE(3, rvec4, slot);    // N, on end a
COUNTERS(4, events);
#if DAMPED
READ(5, rvec4, velocity); // m/s
#endif

KERNEL(count)
{
    Spring s = spring[i];
    rvec4 xa = position[s.a];
    rvec4 xb = position[s.b];
    rvec3 d = rvec3(xa - xb) + rvec3(low[s.a] - low[s.b]);
#if DAMPED
    rvec3 speed = rvec3(velocity[s.a] - velocity[s.b]);
#else
    rvec3 speed = rvec3(real(0));
#endif
    slot[i] = rvec4(spring_force(s.rest_length, s.stiffness, s.damping, d, speed), real(0));
    if (report != 0u)
    {
        if (!spring_has_direction(d) && s.rest_length > real(0) && xa.w + xb.w > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
}
