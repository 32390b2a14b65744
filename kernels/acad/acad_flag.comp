// Which springs are constraints in this substep, and how many of each group of them: the first pass of the
// prefix sum. One that was none, or was one of the other side, starts from the multiplier 0.
//
// Based on: docs/methods/acad.md; shared/acad.glsl.
// Departures: none.
// Bytes per spring (float): 96 read, 8 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/acad.glsl"

PARAMS
{
    uint count; // springs
    uint chunk; // of them a group
    uint groups;
    float activate_high; // strain, as a sum of two floats
    float activate_low;
    float release_high;
    float release_low;
    uint compress; // 1: compressed springs become constraints, too
};

READ(0, Spring, spring);  // kind: 1 where it may become a constraint
READ(1, rvec4, position); // m
READ(2, rvec4, low);      // m
UPDATE(3, uint, flags);
UPDATE(4, real, multiplier); // kg m
WRITE(5, uint, sums);        // a group: rows

SHARED(uint, sum, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    PHASE_BEGIN
    sum[lane] = 0u;
    PHASE_END
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    AcadLimits at = acad_limits(activate_high, activate_low, release_high, release_low, compress);
    EACH_BEGIN(begin, end)
    Spring s = spring[i];
    rvec3 d = rvec3(position[s.a] - position[s.b]) + rvec3(low[s.a] - low[s.b]);
    uint before = flags[i];
    uint now = acad_next(before, s.kind != 0u, d, s.rest_length, at);
    flags[i] = now;
    if (!(before == now && TAUT_ACAD_IS_ROW(now)))
        multiplier[i] = real(0);
    sum[lane] += TAUT_ACAD_IS_ROW(now) ? 1u : 0u;
    EACH_END
    for (uint width = uint(TAUT_LINEAR_GROUP) / 2u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        sum[lane] += sum[lane + width];
        LANES_END
    }
    LANES_BEGIN(1)
    if (group < groups)
        sums[group] = sum[0];
    LANES_END
}
