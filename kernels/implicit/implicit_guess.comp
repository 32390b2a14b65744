// Takes the inertial guess as far as the quadratic model of a Newton step falls along it: x *= x.b / x.A x.
// In free fall the guess is the answer and stays whole; at rest its share is nothing. One group per chunk of
// rows; every group adds up the partial sums itself.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed. 2006, eq. 5.6 (the exact step of a quadratic).
// Departures: none.
// Bytes per row: 4 read, 4 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/cg_state.glsl"

PARAMS
{
    uint count; // rows
    uint chunk;
    uint groups;
};

READ(0, real, products);   // partial sums of x.b, one a group
READ(1, real, curvatures); // of x.A x
UPDATE(2, real, x);

SHARED(real, slope, TAUT_LINEAR_GROUP);
SHARED(real, bend, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    SUM_PARTIALS(slope, products, 0u, groups)
    SUM_PARTIALS(bend, curvatures, 0u, groups)
    real share = bend[0] > real(0) ? slope[0] / bend[0] : real(0);
    share = IS_FINITE(share) ? share : real(0);
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    x[i] *= share;
    EACH_END
}
