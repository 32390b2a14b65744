// What the multipliers x of the rows of four corners (tetrahedra, then hinges) move each vertex by, beside
// what rows of springs do (constraint_spread, which runs before): spread += w J^T x, gathered from the rows
// at the vertex in their order; with APPLY the correction itself, delta -= w J^T x.
//
// Based on: Hong et al., as constraint_rows; Va, Choi, Hong, as volume_rows.
// Departures: none.
// Bytes per corner (float): 24 read, 48 more at the first corner; per vertex 40 read, 16 written.
//! variant apply APPLY=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint first; // number of the first such row in x
};

READ(0, uint, start);    // vertices + 1
READ(1, uint, incident); // 4 * row + corner
READ(2, rvec4, gradient); // 3 a row
READ(3, real, x);
READ(4, rvec4, position); // w = inverse mass
#if APPLY
UPDATE(5, rvec4, delta);
READ_ONE(6, CgState, state);
#else
UPDATE(5, rvec4, spread);
#endif

/// The gradient of corner 0 is what the others leave.
rvec3 gradient_of(uint row, uint corner)
{
    uint at = 3u * row;
    if (corner != 0u)
        return rvec3(gradient[at + corner - 1u]);
    return -((rvec3(gradient[at]) + rvec3(gradient[at + 1u])) + rvec3(gradient[at + 2u]));
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if APPLY
    // Without a right-hand side the answer is 0, whatever the solve was started from.
    bool solved = state[0].status != uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE);
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    rvec3 sum = rvec3(real(0));
    uint last = start[i + 1u];
    for (uint k = start[i]; k < last; ++k)
        sum += gradient_of(incident[k] >> 2u, incident[k] & 3u) * x[first + (incident[k] >> 2u)];
    sum *= position[i].w;
#if APPLY
    rvec4 d = delta[i];
    sum = solved ? sum : rvec3(real(0));
    delta[i] = rvec4(rvec3(d) - sum, d.w);
#else
    spread[i] = rvec4(rvec3(spread[i]) + sum, real(0));
#endif
    EACH_END
}
