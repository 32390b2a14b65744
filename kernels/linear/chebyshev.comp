// One step of a Chebyshev polynomial in D^-1 A applied to a residual: with z_k in hand and q = A z_k,
//   z_{k+1} = z_k + momentum (z_k - z_{k-1}) + gain D^-1 (r - q).
// Nothing is summed but at the last step, which leaves the partial sums of r.z.
//
// Based on: Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, algorithm 12.1.
// Departures: the direction is written as the difference of two iterates and the residual as r - A z_k, so
//   that neither is stored; the first step takes z = gain D^-1 r, the second has no z_{k-1}.
// Bytes per row (float): 20 read, 4 written; 8 and 4 in the first, 16 and 4 in the second step.
//! variant first FIRST=1
//! variant only FIRST=1 LAST=1
//! variant second SECOND=1
//! variant second_last SECOND=1 LAST=1
//! variant last LAST=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint groups;
    float momentum; // rounded alike for every row, so that the polynomial stays one
    float gain;
};

READ(0, real, residual);
READ(1, real, inverse); // 1 / d; 0 = the row is held
#if FIRST
WRITE(2, real, z);
#if LAST
WRITE(3, real, partials); // one a group: r.z
#endif
#else
#if SECOND
WRITE(2, real, z); // z_{k+1}
#else
UPDATE(2, real, z); // z_{k-1}, then z_{k+1}
#endif
READ(3, real, at);      // z_k
READ(4, real, product); // A z_k
#if LAST
WRITE(5, real, partials);
#endif
#endif

#if LAST
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if LAST
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    real m = inverse[i];
    real r = residual[i];
#if FIRST
    real next = m > real(0) ? real(gain) * (m * r) : real(0);
#else
    real here = at[i];
#if SECOND
    real moved = here;
#else
    real moved = here - z[i];
#endif
    real pushed = m > real(0) ? real(gain) * (m * (r - product[i])) : real(0);
    real next = (here + real(momentum) * moved) + pushed;
#endif
    z[i] = next;
#if LAST
    sum[lane] += m > real(0) ? r * next : real(0);
#endif
    EACH_END
#if LAST
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}
