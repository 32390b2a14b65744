// The residual of the aggregates: r_c = P^T r, the sum over the vertices of each, a row for x, y and z.
//
// Based on:
//   Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM 1987.
// Departures: none.
// Bytes per row (float): 4 read, and 4/3 of the table.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // rows: three an aggregate
    uint chunk; // of them a group
};

READ(0, uint, table); // where each aggregate's vertices begin, in this table; the end; then the vertices
READ(1, real, residual);
WRITE(2, real, coarse);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint aggregate = uint(i) / 3u;
    uint axis = uint(i) - 3u * aggregate;
    uint last = table[aggregate + 1u];
    real total = real(0);
    for (uint k = table[aggregate]; k < last; ++k)
        total += residual[3u * table[k] + axis];
    coarse[i] = total;
    EACH_END
}
