// Forces of springs that may become constraints: spring_force, with the force left out where the spring is a
// constraint in this substep. Lengths are known here anyway, so it also counts the springs that the passes
// behind it have to look at; with none of them a substep costs what mass-spring costs, and a comparison.
//
// Based on: docs/methods/acad.md; kernels/mass_spring/spring_force.comp.
// Departures: none.
// Bytes per vertex: 24 read, 16 written; per spring end 24 + 32, damped 16 more, 4 more while any spring is
// a constraint (float).
//! variant damped DAMPED=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/spring.glsl"
#include "shared/acad.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count springs without a direction
    uint springs;
    float activate_high; // strain, as a sum of two floats
    float activate_low;
    float release_high;
    float release_low;
    uint compress; // 1: compressed springs become constraints, too
};

READ(0, uint, start);     // count + 1: the ends at vertex i are end[start[i]] .. end[start[i + 1] - 1]
READ(1, Spring, end);     // a = this vertex, b = the other, kind = 2 * spring + 1 where it may be constrained
READ(2, rvec4, position); // m
READ(3, rvec4, low);      // m, what position lost to rounding
WRITE(4, rvec4, force);   // N
COUNTERS(5, events);
READ(6, uint, flags); // one a spring, then 1 where any may differ from TAUT_ACAD_SPRING
#if DAMPED
READ(7, rvec4, velocity); // m/s
#endif

KERNEL(count)
{
    rvec4 x = position[i];
    rvec4 rest = low[i];
#if DAMPED
    rvec4 v = velocity[i];
#endif
    bool awake = flags[springs] != 0u;
    AcadLimits at = acad_limits(activate_high, activate_low, release_high, release_low, compress);
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
        uint before = awake ? flags[s.kind >> 1u] : TAUT_ACAD_SPRING;
        bool may = (s.kind & 1u) != 0u;
        uint now = acad_next(before, may, d, s.rest_length, at);
        bool row = TAUT_ACAD_IS_ROW(now);
        rvec3 f = spring_force(s.rest_length, s.stiffness, s.damping, d, speed);
        sum += row ? rvec3(real(0)) : f;
        // Each spring is met at both ends; the lower one counts it.
        if ((row || before != TAUT_ACAD_SPRING) && i < s.b)
            COUNT_EVENT(events, TAUT_EVENT_ACAD);
        if (report != 0u)
        {
            if (i < s.b && !spring_has_direction(d) && s.rest_length > real(0) && x.w + far.w > real(0))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    force[i] = rvec4(sum, real(0));
}
