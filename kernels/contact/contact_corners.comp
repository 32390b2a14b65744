// Which corners of pairs each vertex is: puts 4 pair + corner into the row of the corner's vertex. Their
// order there is chance, and contact_sort makes it that of their numbers. One invocation per pair.
//
// Based on: counting sort.
// Departures: none.
// Bytes per pair: 20 + 4 a corner read, 8 a corner written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint capacity;
};

READ(0, ContactPair, pair);
READ(1, uint, control);
READ(2, uint, start); // of each vertex among `corner`, and the end
WRITE(3, uint, corner);
COUNTERS(4, taken); // of each vertex' places

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        corner[start[p.a] + NEXT_EVENT(taken, p.a)] = 4u * i;
        corner[start[p.b] + NEXT_EVENT(taken, p.b)] = 4u * i + 1u;
        corner[start[p.c] + NEXT_EVENT(taken, p.c)] = 4u * i + 2u;
        corner[start[p.d] + NEXT_EVENT(taken, p.d)] = 4u * i + 3u;
    }
}
