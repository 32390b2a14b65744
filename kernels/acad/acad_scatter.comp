// The last pass of the prefix sum: the elements that carry the flag TAUT_ACAD_ROW, side by side in their own
// order, and with PLACE for each element where it stands in that list.
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
        bool has = window + lane < end && flags[element] == TAUT_ACAD_ROW;
        before[lane] = has ? 1u : 0u;
        PHASE_END
        SCAN_LANES(before, other)
        uint last = min(window + uint(TAUT_LINEAR_GROUP), end);
        EACH_BEGIN(window, last)
        bool has = flags[i] == TAUT_ACAD_ROW;
        uint to = at + before[lane] - 1u;
        if (has)
            list[to + 1u] = uint(i);
#if PLACE
        place[i] = has ? to : TAUT_NO_ROW;
#endif
        EACH_END
        at += before[TAUT_LINEAR_GROUP - 1];
        PHASE_BEGIN // the last sum was read by all lanes
        PHASE_END
    }
}
