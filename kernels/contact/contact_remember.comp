// What pairs remember of their friction, and which pairs they were, before a search numbers them anew. One
// invocation per vertex, for the pairs whose first corner it is.
//
// Based on: Catto. Iterative Dynamics with Temporal Coherence. GDC 2005 (contacts keep what they know while
//   they last).
// Departures: none.
// Bytes per pair: 4 a corner and 20 + 32 read, as much written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint count; // vertices
};

READ(0, uint, start); // of each vertex among `corner`, and the end
READ(1, uint, corner);
READ(2, ContactPair, pair);
READ(3, rvec4, side); // the four rows of a ContactSide
WRITE(4, ContactPair, known);
WRITE(5, rvec4, memory); // two a pair: the last two rows of its side

KERNEL(count)
{
    uint first = start[i];
    uint size = start[i + 1u] - first;
    size = size > TAUT_CONTACT_CROWD ? 0u : size;
    for (uint k = first; k < first + size; ++k)
    {
        uint j = corner[k] / 4u;
        if (corner[k] == 4u * j)
        {
            known[j] = pair[j];
            memory[2u * j] = side[4u * j + 2u];
            memory[2u * j + 1u] = side[4u * j + 3u];
        }
    }
}
