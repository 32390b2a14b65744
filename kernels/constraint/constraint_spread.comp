// What the multipliers x of all rows move each vertex by: w J^T x, gathered from the rows at the vertex in
// their order. It is half of the product A x, and with APPLY the correction itself: delta -= w J^T x.
//
// Based on: Hong et al., as constraint_rows.
// Departures: with LISTED only the vertices of a list are visited, and springs that have no row are passed
//   over (acad).
// Bytes per row (float): 48 read; per vertex 24 read, 16 written (APPLY 40 and 16).
//! variant apply APPLY=1
//! variant listed LISTED=1
//! variant listed_apply LISTED=1 APPLY=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // vertices; with LISTED the most there may be
    uint chunk; // of them a group
};

READ(0, uint, start);    // vertices + 1
READ(1, uint, incident); // 2 * spring + end
READ(2, rvec4, direction);
READ(3, real, x);
READ(4, rvec4, position); // w = inverse mass
#if APPLY
UPDATE(5, rvec4, delta);
#if !LISTED
READ_ONE(6, CgState, state);
#endif
#else
WRITE(5, rvec4, spread);
#endif
#if LISTED
READ(6, uint, list);  // how many vertices, then the vertices
READ(7, uint, place); // of each spring: its row, or TAUT_NO_ROW
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if LISTED
    uint most = min(count, list[0]);
#else
    uint most = count;
#endif
#if APPLY && !LISTED
    // Without a right-hand side the answer is 0, whatever the solve was started from.
    bool solved = state[0].status != uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE);
#endif
    uint begin = min(group * chunk, most);
    uint end = min(begin + chunk, most);
    EACH_BEGIN(begin, end)
#if LISTED
    uint v = list[i + 1u];
#else
    uint v = uint(i);
#endif
    rvec3 sum = rvec3(real(0));
    uint last = start[v + 1u];
    for (uint k = start[v]; k < last; ++k)
    {
        uint at = incident[k];
        uint r = at >> 1u;
#if LISTED
        r = place[r];
        if (r == TAUT_NO_ROW)
            continue;
#endif
        real signed_x = (at & 1u) == 0u ? x[r] : -x[r];
        sum += rvec3(direction[r]) * signed_x;
    }
    sum *= position[v].w;
#if APPLY
    rvec4 d = delta[v];
#if !LISTED
    sum = solved ? sum : rvec3(real(0));
#endif
    delta[v] = rvec4(rvec3(d) - sum, d.w);
#else
    spread[v] = rvec4(sum, real(0));
#endif
    EACH_END
}
