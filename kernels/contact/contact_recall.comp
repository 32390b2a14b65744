// What pairs of the new list know of their friction from the old one, where they were in it. One invocation
// per pair, among the old pairs with the same first corner.
//
// Based on: Catto. Iterative Dynamics with Temporal Coherence. GDC 2005.
// Departures: found by their corners, whose order the tree of the surfaces fixes.
// Bytes per pair: 20 + 8 read, 24 an old pair at its first corner, 32 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint capacity;
};

READ(0, ContactPair, pair);
READ(1, uint, control);
READ(2, uint, start); // of each vertex among `corner`, and the end: of the old list
READ(3, uint, corner);
READ(4, ContactPair, known); // of the old list
READ(5, rvec4, memory);      // two an old pair
UPDATE(6, rvec4, side);      // the four rows of a ContactSide

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        uint first = start[p.a];
        uint size = start[p.a + 1u] - first;
        size = size > TAUT_CONTACT_CROWD ? 0u : size;
        for (uint k = first; k < first + size; ++k)
        {
            uint j = corner[k] / 4u;
            if (corner[k] != 4u * j)
                continue;
            ContactPair q = known[j];
            if (q.b == p.b && q.c == p.c && q.d == p.d && q.kind == p.kind)
            {
                side[4u * i + 2u] = memory[2u * j];
                side[4u * i + 3u] = memory[2u * j + 1u];
            }
        }
    }
}
