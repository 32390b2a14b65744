// The rows of the springs that are constraints, side by side, as the passes of a solve want them.
//
// Based on: docs/methods/acad.md.
// Departures: none.
// Bytes per row (float): 36 read, 32 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // most rows there may be
    uint chunk; // of them a group
    uint further; // 1: not the first solve of the substep, so it starts from 0
};

READ(0, uint, row_list);        // how many, then the springs
READ(1, Spring, candidate);     // a spring as a constraint: the length that it aims at, and its stiffness
READ(2, real, candidate_inverse);
READ(3, real, multiplier);      // kg m, a spring
WRITE(4, Spring, row);
WRITE(5, real, x);
WRITE(6, real, inverse);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint rows = min(count, row_list[0]);
    uint begin = min(group * chunk, rows);
    uint end = min(begin + chunk, rows);
    EACH_BEGIN(begin, end)
    uint s = row_list[i + 1u];
    row[i] = candidate[s];
    x[i] = further != 0u ? real(0) : multiplier[s];
    inverse[i] = candidate_inverse[s];
    EACH_END
}
