// Adds the elastic tetrahedra's part to the product of a Newton step's matrix with a vector, or takes it from
// a residual, from the 9 x 9 matrices of implicit_solids. A lane a vertex.
//
// Based on: implicit_solid_blocks.comp.
// Departures: none.
// Bytes per vertex: 20 read, 12 updated; per tetrahedron at it 76 + 228 (float).
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
};

READ(0, SolidTetrahedron, solid);
READ(1, real, state); // shared/solid_state.h
READ(2, uint, table); // as in implicit_solid_blocks
READ(3, real, x);
UPDATE(4, real, y);
#if DOT
WRITE(5, real, partials); // sums of x_i y_i, y as it is afterwards
#endif
#include "shared/implicit_solid.glsl"

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

rvec3 at(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

rvec3 product(uint i)
{
    rvec3 result = rvec3(real(0));
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = TAUT_IMPLICIT_BEGIN(i); k < end; k += 5u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        SolidTetrahedron t = solid[word >> 2u];
        uint from = TAUT_SOLID_STATE * (word >> 2u);
        rvec3 own = corner_row(t, word & 3u);
        rvec3 e0 = at(t.a);
        rvec3 e1 = at(t.b) - e0;
        rvec3 e2 = at(t.c) - e0;
        rvec3 e3 = at(t.d) - e0;
        // How F changes, by columns, and what the stress does.
        rvec3 f0 = (e1 * t.b00 + e2 * t.b10) + e3 * t.b20;
        rvec3 f1 = (e1 * t.b01 + e2 * t.b11) + e3 * t.b21;
        rvec3 f2 = (e1 * t.b02 + e2 * t.b12) + e3 * t.b22;
        rvec3 p0 = (own_times(from + 9u, f0) + block_times(from + 27u, f1)) + block_times(from + 36u, f2);
        rvec3 p1 = (turned_times(from + 27u, f0) + own_times(from + 15u, f1)) + block_times(from + 45u, f2);
        rvec3 p2 = (turned_times(from + 36u, f0) + turned_times(from + 45u, f1)) + own_times(from + 21u, f2);
        result += (p0 * own.x + p1 * own.y) + p2 * own.z;
    }
    return result;
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint v = uint(i);
    rvec3 more = product(v);
#if RESIDUAL
    more = -more;
#endif
    rvec3 result = rvec3(y[3u * v], y[3u * v + 1u], y[3u * v + 2u]) + more;
#if DOT
    sum[lane] += dot(at(v), result);
#endif
    y[3u * v] = result.x;
    y[3u * v + 1u] = result.y;
    y[3u * v + 2u] = result.z;
    EACH_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}
