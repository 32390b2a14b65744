// Gives the step of every part that nothing holds the momentum that it must have: forces within a part add up
// to nothing, so its centre of mass moves by the inertial guess, whatever a solve that was cut short says. A
// group per part shifts it as a whole, which only lowers the quadratic model of the Newton step.
//
// Based on: Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM
//   1987: an error along known directions is taken out exactly (here the translations of a part).
// Departures: once, after the solve; not in its iterations. With CONTACT a part of which a collider holds a
//   vertex stays as the solve left it: the collider pushes it too.
// Bytes per vertex: 64 read, 12 updated; contact 4 more read (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/cg_state.glsl"

PARAMS
{
    uint count; // parts
    float lift; // as in implicit_force
};

READ(0, uint, start);      // count + 1: the part's vertices are member[start[p]] .. member[start[p + 1] - 1]
READ(1, uint, member);
READ(2, rvec4, position);  // w = inverse mass 1/kg, > 0
READ(3, rvec4, delta);     // m
READ(4, rvec4, predicted); // m
UPDATE(5, real, x);        // the step, lifted
#if CONTACT
READ(6, uint, marks); // three words a vertex; not 0: stays where it is (implicit_hold.comp)
SHARED(real, stopped, TAUT_LINEAR_GROUP);
#endif

SHARED(real, sum_x, TAUT_LINEAR_GROUP);
SHARED(real, sum_y, TAUT_LINEAR_GROUP);
SHARED(real, sum_z, TAUT_LINEAR_GROUP);
SHARED(real, mass, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    CLEAR_LANES(sum_x)
    CLEAR_LANES(sum_y)
    CLEAR_LANES(sum_z)
    CLEAR_LANES(mass)
#if CONTACT
    CLEAR_LANES(stopped)
#endif
    uint begin = start[min(group, count)];
    uint end = start[min(group + 1u, count)];
    EACH_BEGIN(begin, end)
    uint v = member[i];
    real m = real(1) / position[v].w;
    rvec3 step = rvec3(x[3u * v], x[3u * v + 1u], x[3u * v + 2u]);
    rvec3 lack = rvec3(predicted[v] - delta[v]) * real(lift) - step;
    sum_x[lane] += m * lack.x;
    sum_y[lane] += m * lack.y;
    sum_z[lane] += m * lack.z;
    mass[lane] += m;
#if CONTACT
    stopped[lane] += real(marks[3u * v]);
#endif
    EACH_END
    SUM_LANES_2(sum_x, sum_y)
    SUM_LANES_2(sum_z, mass)
    real whole = mass[0] > real(0) ? mass[0] : real(1);
    real size = abs(sum_x[0]) + abs(sum_y[0]) + abs(sum_z[0]);
    bool finite = IS_FINITE(size / whole);
#if CONTACT
    SUM_LANES(stopped)
    finite = finite && stopped[0] == real(0);
#endif
    rvec3 shift = rvec3(sum_x[0] / whole, sum_y[0] / whole, sum_z[0] / whole);
    shift = finite ? shift : rvec3(real(0));
    EACH_BEGIN(begin, end)
    uint v = member[i];
    x[3u * v] += shift.x;
    x[3u * v + 1u] += shift.y;
    x[3u * v + 2u] += shift.z;
    EACH_END
}
