// The other half of the product A x of implicit constraints, A = J W J^T + compliance: what moves `spread`
// of both ends (constraint_spread) do to the length of each row.
//
// Based on: Hong et al., as constraint_rows.
// Departures: none.
// Bytes per row (float): 60 read (64 with b), 4 written.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint groups;
};

READ(0, Spring, row);
READ(1, rvec4, direction); // w = what compliance adds to the diagonal
READ(2, rvec4, spread);    // a vertex
READ(3, real, x);
WRITE(4, real, y);
#if DOT
WRITE(5, real, partials); // sums of x_i y_i
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
    rvec4 n = direction[i];
    rvec3 apart = rvec3(spread[row[i].a]) - rvec3(spread[row[i].b]);
    real value = x[i];
    PRECISE real result = dot(rvec3(n), apart) + n.w * value;
#if RESIDUAL
    y[i] = b[i] - result;
#else
    y[i] = result;
#endif
#if DOT
    sum[lane] += value * result;
#endif
    EACH_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}
