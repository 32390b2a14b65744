// After a solve: the multipliers of the rows go back to their springs, and a row whose spring alone would
// hold the length is released.
//
// Based on: methods of active sets; docs/methods/acad.md (released when lambda < k tau L).
// Departures: lambda is the mean of this substep and the one before. A substep that pulls an overshoot back
//   leaves the speed of that, and the next takes it away with a multiplier that is as much too small.
// Bytes per row (float): 20 read, 8 written; with TOTAL 4 more read and written.
//! variant total TOTAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // most rows there may be
    uint chunk; // of them a group
    uint further; // 1: not the first solve of the substep
    uint last;    // 1: the last solve of the substep
    uint release; // 1: multipliers decide
};

READ(0, uint, row_list); // how many, then 2 * spring, and 1 more for a compressed one
UPDATE(1, real, x);
UPDATE(2, real, multiplier); // kg m, a spring: of all solves of the substep before; 0: it was no constraint
UPDATE(3, uint, flags);
READ(4, real, hold); // N, a spring: how strong it is at the length that the constraint aims at
READ_ONE(5, CgState, state);
READ_ONE(6, StepValues, step_values);
#if TOTAL
UPDATE(7, real, total); // kg m, a row: of the solves of this substep so far
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint rows = min(count, row_list[0]);
    uint begin = min(group * chunk, rows);
    uint end = min(begin + chunk, rows);
    real h = step_values[0].substep;
    // Without a right-hand side the answer is 0, whatever the solve was started from.
    bool solved = state[0].status != uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE);
    EACH_BEGIN(begin, end)
    uint entry = row_list[i + 1u];
    uint s = entry >> 1u;
    real found = solved ? x[i] : real(0);
    real sum = found;
    x[i] = found;
#if TOTAL
    sum = further != 0u ? total[i] + found : found;
    total[i] = sum;
#endif
    if (last != 0u)
    {
        real before = multiplier[s];
        multiplier[s] = sum;
        real both = sum + before;
        real carried = (entry & 1u) != 0u ? -both : both; // a compressed row pushes
        if (release != 0u && before != real(0) && carried < real(2) * (hold[s] * (h * h)))
            flags[s] = TAUT_ACAD_RELEASED;
    }
    EACH_END
}
