// Partial sums of a dot product, one a group; whoever needs the whole adds them up (SUM_PARTIALS).
//
// Based on: a tree of 128 lanes, each with every 128th product: the error grows with the logarithm of the
//   lanes and a 128th of the rows (Higham. Accuracy and Stability of Numerical Algorithms, 2nd ed., 4.2).
// Departures: none.
// Bytes per row (float): 8 read.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint groups;
};

READ(0, real, x);
READ(1, real, y);
WRITE(2, real, partials); // one a group

SHARED(real, sum, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    CLEAR_LANES(sum)
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    sum[lane] += x[i] * y[i];
    EACH_END
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
}
