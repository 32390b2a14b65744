// The rows of four corners (tetrahedra, then hinges) in the product A x of implicit constraints, beside those
// of springs (constraint_product, which runs before): what moves `spread` of its corners do to each volume or
// angle. Its share of x . A x is added to what each group has there already.
//
// Based on: Hong et al., as constraint_rows; Va, Choi, Hong, as volume_rows.
// Departures: none.
// Bytes per row (float): 24 + 48 + 64 + 4 read (144 with b), 4 written.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint count; // rows of four corners
    uint chunk; // of them a group
    uint first; // row of the first of them
    uint groups;
};

READ(0, VolumeConstraint, corners); // of hinges too, whose records begin with four corners as well
READ(1, rvec4, gradient); // 3 a row; w = what compliance adds to the diagonal
READ(2, rvec4, spread);   // a vertex
READ(3, real, x);
UPDATE(4, real, y);
#if DOT
UPDATE(5, real, partials); // sums of x_i y_i
#elif RESIDUAL
READ(5, real, b);
#endif

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    VolumeConstraint t = corners[i];
    rvec3 origin = rvec3(spread[t.a]);
    rvec4 g1 = gradient[3u * i];
    real change = dot(rvec3(g1), rvec3(spread[t.b]) - origin);
    change += dot(rvec3(gradient[3u * i + 1u]), rvec3(spread[t.c]) - origin);
    change += dot(rvec3(gradient[3u * i + 2u]), rvec3(spread[t.d]) - origin);
    real value = x[first + uint(i)];
    PRECISE real result = change + g1.w * value;
#if RESIDUAL
    y[first + uint(i)] = b[first + uint(i)] - result;
#else
    y[first + uint(i)] = result;
#endif
#if DOT
    sum[lane] += value * result;
#endif
    EACH_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] += sum[0];
    LANES_END
#endif
}
