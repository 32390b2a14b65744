// The last pass of the prefix sum: the elements whose flag is that of a row, side by side in their own order.
// With PLACE the list says 2 * element, and 1 more for a compressed row, and each element where it stands.
//
// Based on: docs/methods/acad.md; shared/scan.glsl.
// Departures: none.
// Bytes per element: 4 read, 4 written, 4 more with PLACE.
//! variant place PLACE=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"
#include "shared/scan.glsl"

PARAMS
{
    uint count;
    uint chunk; // a multiple of the lanes
    uint first; // where the groups' beginnings stand among `sums`
    uint groups;
};

READ(0, uint, flags);
READ(1, uint, sums);
WRITE(2, uint, list); // from [1] on
#if PLACE
WRITE(3, uint, place); // index in the list without its first word, or TAUT_NO_ROW
#endif

SHARED(uint, before, TAUT_LINEAR_GROUP); // and with the lane's own
SHARED(uint, other, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    uint at = sums[first + min(group, groups - 1u)];
    for (uint window = begin; window < end; window += uint(TAUT_LINEAR_GROUP))
    {
        PHASE_BEGIN
        uint element = min(window + lane, count - 1u);
        bool has = window + lane < end && TAUT_ACAD_IS_ROW(flags[element]);
        before[lane] = has ? 1u : 0u;
        PHASE_END
        SCAN_LANES(before, other)
        uint last = min(window + uint(TAUT_LINEAR_GROUP), end);
        EACH_BEGIN(window, last)
        uint flag = flags[i];
        bool has = TAUT_ACAD_IS_ROW(flag);
        uint to = at + before[lane] - 1u;
#if PLACE
        uint entry = 2u * uint(i) + (flag == TAUT_ACAD_PRESSED ? 1u : 0u);
#else
        uint entry = uint(i);
#endif
        if (has)
            list[to + 1u] = entry;
#if PLACE
        place[i] = has ? to : TAUT_NO_ROW;
#endif
        EACH_END
        at += before[TAUT_LINEAR_GROUP - 1];
        PHASE_BEGIN // the last sum was read by all lanes
        PHASE_END
    }
}
