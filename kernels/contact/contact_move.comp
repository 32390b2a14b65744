// Moves each vertex by the impulses of its pairs, in the order of their numbers, and sets back how many act:
//
//   d += w sum b_k impulse.
//
// One invocation per vertex.
//
// Based on: Tonge et al. 2012, as contact_push says.
// Departures: none.
// Bytes per vertex: 12 + 36 a corner + 32 read, 20 written (float).
#include "shared/portable.glsl"
#include "shared/contact_rows.h"

PARAMS
{
    uint count; // vertices
};

READ(0, uint, start);     // of each vertex among `corner`, and the end
READ(1, uint, corner);    // 4 pair + corner
READ(2, real, row);       // as contact_gap leaves it: 8 a pair, the first 4 the weights
READ(3, rvec4, impulse);  // kg m, of each pair
READ(4, rvec4, position); // w = inverse mass
UPDATE(5, rvec4, delta);  // m
UPDATE(6, uint, acting);   // pairs of the vertex that act: where none does, impulses are not looked at

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    uint first = start[i];
    uint end = start[i + 1u];
    if (end - first > TAUT_CONTACT_CROWD || acting[i] == 0u)
        end = first;
    for (uint k = first; k < end; ++k)
    {
        uint c = corner[k];
        uint p = c >> 2u;
        sum += rvec3(impulse[p]) * row[8u * p + (c & 3u)];
    }
    rvec4 d = delta[i];
    delta[i] = rvec4(rvec3(d) + sum * position[i].w, d.w);
    acting[i] = 0u;
}
