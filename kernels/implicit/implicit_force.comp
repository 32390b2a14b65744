// The right-hand side of a Newton step of backward Euler without its hinges: M (guess - displacement) +
// h^2 (forces of springs and dampers), gathered. One invocation per vertex; every spring is evaluated at both
// ends, in the order of the springs.
//
// Based on: Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, eq. 16, in displacements
//   (Martin et al. Example-Based Elastic Materials. SIGGRAPH 2011, eq. 2: the potential whose slope it is).
// Departures: the damper's force is of the velocity that the displacement means, which makes the right-hand
//   side that of the textbook (f - h K v) with the displacement for the unknown.
// Bytes per vertex: 72 read, 12 written; per spring end 32 + 24, damped 16 more (float).
//! variant damped DAMPED=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/implicit_spring.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count;
    float scale; // power of two: the system is in these units of mass
    float lift;  // power of two: and its unknowns are displacements times this
};

READ(0, rvec4, position);  // m, w = inverse mass 1/kg
READ(1, rvec4, delta);     // m
READ(2, rvec4, predicted); // m
READ(3, Spring, spring);
READ(4, uint, table); // shared/implicit_table.glsl; an entry is 2 * spring + end, place
READ_ONE(5, StepValues, step_values);
WRITE(6, real, b); // three a vertex
#if DAMPED
READ(7, rvec4, low); // m
#endif

KERNEL(count)
{
    rvec4 x = position[i];
    rvec4 moved = delta[i];
    real h = step_values[0].substep;
    rvec3 pull = rvec3(real(0));
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = TAUT_IMPLICIT_BEGIN(i); k < end; k += 2u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        Spring s = spring[word >> 1u];
        uint far = (word & 1u) == 0u ? s.b : s.a;
        rvec3 d = rvec3(x - position[far]) + rvec3(moved - delta[far]);
        rvec3 v = rvec3(real(0));
#if DAMPED
        v = (rvec3(moved - delta[far]) - rvec3(low[i] - low[far])) / h;
#endif
        pull += spring_pull(s.rest_length, s.stiffness, s.damping, d, v);
    }
    real mass = x.w > real(0) ? real(1) / x.w : real(0);
    rvec3 lack = rvec3(predicted[i] - moved);
    rvec3 side = (lack * mass + (pull * h) * h) * (real(scale) * real(lift));
    b[3u * i] = side.x;
    b[3u * i + 1u] = side.y;
    b[3u * i + 2u] = side.z;
}
