// Which vertices are ends of constraints, and how many of each group of them.
//
// Based on: docs/methods/acad.md.
// Departures: none.
// Bytes per vertex: 8 read, 4 written; per spring end 8 read.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
};

READ(0, uint, start);    // count + 1
READ(1, uint, incident); // 2 * spring + end
READ(2, uint, flags);
WRITE(3, uint, touched); // TAUT_ACAD_ROW or TAUT_ACAD_SPRING
WRITE(4, uint, sums);    // behind those of springs: a group: vertices

SHARED(uint, sum, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    PHASE_BEGIN
    sum[lane] = 0u;
    PHASE_END
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint any = TAUT_ACAD_SPRING;
    uint last = start[i + 1u];
    for (uint k = start[i]; k < last; ++k)
        any = TAUT_ACAD_IS_ROW(flags[incident[k] >> 1u]) ? TAUT_ACAD_ROW : any;
    touched[i] = any;
    sum[lane] += any == TAUT_ACAD_ROW ? 1u : 0u;
    EACH_END
    for (uint width = uint(TAUT_LINEAR_GROUP) / 2u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        sum[lane] += sum[lane + width];
        LANES_END
    }
    LANES_BEGIN(1)
    if (group < groups)
        sums[groups + group] = sum[0];
    LANES_END
}
