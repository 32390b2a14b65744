// Adds what the iteration has gained since the last time to the solution: base += x, x = 0. With PAIR the
// base is an unevaluated sum of two numbers a row, so that float keeps some 48 bits of the solution.
//
// Based on: Knuth. The Art of Computer Programming 2, 4.2.2, theorem B (two_sum).
// Departures: none.
// Bytes per row (float): 8 read, 8 written; 12 and 12 with PAIR.
//! variant pair PAIR=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint add;   // 0: only x = 0
};

UPDATE(0, real, base); // count rows; with PAIR two words a row, high and low
UPDATE(1, real, x);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    if (add != 0u)
    {
#if PAIR
        TwoFloat sum = two_float_add(two_float(base[2u * i], base[2u * i + 1u]), x[i]);
        base[2u * i] = sum.high;
        base[2u * i + 1u] = sum.low;
#else
        base[i] += x[i];
#endif
    }
    x[i] = real(0);
    EACH_END
}
