// Trials of a line search, the whole step and its halves, evaluated in passes: a pass of shorter ones has
// something to do only where every trial before them raises the potential. Every group decides alike.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed. 2006, 3.1 (backtracking).
// Departures: trials of a pass are evaluated at once, and nothing waits for a decision of the host.
#ifndef TAUT_SHARED_LINE_SEARCH_GLSL
#define TAUT_SHARED_LINE_SEARCH_GLSL

#include "shared/line_search.h"

/// rise[k] becomes the sum of the `width` partial sums of trial k, for k from 0 to the first that does not
/// raise the potential, which is the last (`taken`), or to n - 1; what is no number raises it. `tried`: how
/// many. `rise` and `sum` are SHARED.
#define SUM_TRIALS(rise, sum, partials, n, width, tried, taken)               \
    uint tried = 0u;                                                          \
    bool taken = false;                                                       \
    for (; tried < uint(n) && !taken; ++tried)                                \
    {                                                                         \
        SUM_PARTIALS(sum, partials, tried * uint(width), width)               \
        LANES_BEGIN(1)                                                        \
        rise[tried] = sum[0];                                                 \
        LANES_END                                                             \
        taken = IS_FINITE(rise[tried]) ? rise[tried] <= real(0) : false;      \
    }

/// Of the whole step, that of trial k: 2^-k.
real trial_share(uint k)
{
    real share = real(1);
    for (uint halved = 0u; halved < k; ++halved)
        share *= real(0.5);
    return share;
}

#endif
