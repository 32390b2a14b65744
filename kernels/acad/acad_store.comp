// After a solve: the multipliers of the rows go back to their springs, and a row whose spring alone would
// hold the length is released.
//
// Based on: methods of active sets; docs/methods/acad.md (released when lambda < k tau L).
// Departures: none.
// Bytes per row (float): 16 read, 8 written; with TOTAL 4 more written.
//! variant total TOTAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // most rows there may be
    uint chunk; // of them a group
    uint further; // 1: not the first solve of the substep
    uint release; // 1: after the last solve, where multipliers decide
};

READ(0, uint, row_list);
UPDATE(1, real, x);
UPDATE(2, real, multiplier); // kg m, a spring: of all solves of the substep
UPDATE(3, uint, flags);
READ(4, real, hold); // N, a spring: its own force at the length that the constraint aims at
READ_ONE(5, CgState, state);
READ_ONE(6, StepValues, step_values);
#if TOTAL
WRITE(7, real, total); // a row
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
    uint s = row_list[i + 1u];
    real found = solved ? x[i] : real(0);
    real sum = further != 0u ? multiplier[s] + found : found;
    x[i] = found;
    multiplier[s] = sum;
#if TOTAL
    total[i] = sum;
#endif
    if (release != 0u)
    {
        if (sum < hold[s] * (h * h))
            flags[s] = TAUT_ACAD_RELEASED;
    }
    EACH_END
}
