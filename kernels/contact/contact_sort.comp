// The corners of pairs at each vertex in ascending order, whatever order they came in; and the counters that
// were used to find them, set back. One invocation per vertex.
//
// Based on: Ciura. Best Increments for the Average Case of Shellsort. FCT 2001.
// Departures: rows of more than TAUT_CONTACT_CROWD corners are left alone and counted: nobody uses them.
// Bytes per vertex: 8 read, 8 written, and some 8 a corner each way.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint count; // vertices
};

READ(0, uint, start);
UPDATE(1, uint, corner);
WRITE(2, uint, corners);
WRITE(3, uint, taken);
COUNTERS(4, lost);

uint next_gap(uint gap)
{
    uint small = gap == 10u ? 4u : (gap == 4u ? 1u : 0u);
    uint middle = gap == 57u ? 23u : (gap == 23u ? 10u : small);
    return gap == 301u ? 132u : (gap == 132u ? 57u : middle);
}

KERNEL(count)
{
    uint first = start[i];
    uint size = start[i + 1u] - first;
    corners[i] = 0u;
    taken[i] = 0u;
    bool crowded = size > TAUT_CONTACT_CROWD;
    COUNT_EVENT_IF(crowded, lost, TAUT_CONTACT_CROWDED);
    uint gap = crowded ? 0u : 301u;
    while (gap > 0u)
    {
        for (uint k = gap; k < size; ++k)
        {
            uint value = corner[first + k];
            uint at = k;
            while (at >= gap && corner[first + at - gap] > value)
            {
                corner[first + at] = corner[first + at - gap];
                at -= gap;
            }
            corner[first + at] = value;
        }
        gap = next_gap(gap);
    }
}
