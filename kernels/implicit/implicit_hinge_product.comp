// Adds the hinges' part to the product of a Newton step's matrix with a vector, or takes it from a residual,
// with the gradients formed again from the places of the corners. A lane a vertex.
//
// Based on: implicit_hinges.comp.
// Departures: none.
// Bytes per vertex: 36 read, 12 updated; per hinge corner 44 + 140 (float).
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/hinge.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
    float scale; // as in implicit_force
};

READ(0, rvec4, position); // m
READ(1, rvec4, delta);    // m
READ(2, BendingConstraint, hinge);
READ(3, uint, table); // as in implicit_hinges
READ_ONE(4, StepValues, step_values);
READ(5, real, x);
UPDATE(6, real, y);
#if DOT
WRITE(7, real, partials); // sums of x_i y_i, y as it is afterwards
#endif

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

rvec3 at(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

rvec3 product(uint i)
{
    real h = step_values[0].substep;
    rvec3 result = rvec3(real(0));
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = TAUT_IMPLICIT_BEGIN(i); k < end; k += 5u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        BendingConstraint c = hinge[word >> 2u];
        uint corner = word & 3u;
        HingeShape s = hinge_shape(between(c.edge0, c.edge1), between(c.edge0, c.wing0),
                                   between(c.edge0, c.wing1));
        if (s.shaped)
        {
            rvec3 own = corner == 0u ? s.edge0 : corner == 1u ? s.edge1 : corner == 2u ? s.wing0 : s.wing1;
            real turn = (dot(s.edge0, at(c.edge0)) + dot(s.edge1, at(c.edge1))) +
                        (dot(s.wing0, at(c.wing0)) + dot(s.wing1, at(c.wing1)));
            result += own * (((h / c.compliance) * h) * turn);
        }
    }
    return result * real(scale);
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
