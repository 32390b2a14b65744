// Where the entries of each row begin when rows lie one after another: start_k = sum of count_j, j < k, and
// the sum of all at the end. With ROWS, of the rows of pairs, it also says how many there are and how many
// work groups the passes over them take. One group.
//
// Based on: shared/scan.glsl.
// Departures: each lane adds a stretch of its own first.
// GUARD, with the guarantee, says whether the search has left anything out: then all stand still.
// Bytes per row: 8 read, 4 written; ROWS 4 more read.
//! variant rows ROWS=1
//! variant guarded_rows ROWS=1 GUARD=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/scan.glsl"

PARAMS
{
    uint count;    // rows
    uint capacity; // ROWS: pairs that the list holds
    uint vertices; // ROWS
};

READ(0, uint, found);  // entries of each row
WRITE(1, uint, start); // one more than rows
#if ROWS
READ(2, uint, compared);
UPDATE(3, uint, control);
#endif
#if GUARD
READ(4, uint, lost);
#endif

SHARED(uint, before, TAUT_LINEAR_GROUP); // and with the lane's own
SHARED(uint, other, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint chunk = (count + uint(TAUT_LINEAR_GROUP) - 1u) / uint(TAUT_LINEAR_GROUP);
    PHASE_BEGIN
    uint sum = 0u;
    for (uint k = min(lane * chunk, count); k < min((lane + 1u) * chunk, count); ++k)
        sum += found[k];
    before[lane] = sum;
    PHASE_END
    SCAN_LANES(before, other)
    PHASE_BEGIN
    uint at = lane > 0u ? before[max(lane, 1u) - 1u] : 0u;
    for (uint k = min(lane * chunk, count); k < min((lane + 1u) * chunk, count); ++k)
    {
        start[k] = at;
        at += found[k];
    }
    if (lane == 0u)
        start[count] = before[TAUT_LINEAR_GROUP - 1];
    PHASE_END
#if ROWS
    uint total = before[TAUT_LINEAR_GROUP - 1];
    PHASE_BEGIN // all lanes have it
    PHASE_END
    PHASE_BEGIN
    uint sum = 0u;
    for (uint k = min(lane * chunk, count); k < min((lane + 1u) * chunk, count); ++k)
        sum += compared[k];
    before[lane] = sum;
    PHASE_END
    SCAN_LANES(before, other)
    LANES_BEGIN(1)
    uint listed = min(total, capacity);
    if (group == 0u)
    {
        uint size = TAUT_CONTACT_GROUP;
        control[TAUT_CONTACT_PAIR_GROUPS] = (listed + size - 1u) / size;
        control[TAUT_CONTACT_VERTEX_GROUPS] = listed > 0u ? (vertices + size - 1u) / size : 0u;
        control[TAUT_CONTACT_LISTED] = listed;
        control[TAUT_CONTACT_FOUND] = total;
        control[TAUT_CONTACT_COMPARED] = before[TAUT_LINEAR_GROUP - 1];
        control[TAUT_CONTACT_MISSING] += total - listed;
        control[TAUT_CONTACT_GATE_PAIRS] = control[TAUT_CONTACT_PAIR_GROUPS];
#if GUARD
        bool left_out = total > listed || lost[TAUT_CONTACT_CUT] != control[TAUT_CONTACT_CUT_SEEN];
        control[TAUT_CONTACT_HOLDS] = left_out ? 1u : 0u;
        control[TAUT_CONTACT_CUT_SEEN] = lost[TAUT_CONTACT_CUT];
#endif
    }
    LANES_END
#endif
}
