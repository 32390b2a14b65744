// Every entry of a matrix, row after row: y = A x. The lanes of a group share the columns of a row.
//
// Based on: Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented
//   Processors. SC 2009 (vector CSR, without its columns).
// Departures: the tree of sums has one fixed order, so that the result repeats to the last bit.
// Bytes per entry (float): 4 read; pairs 8.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // rows and columns, at most 65,535
    uint chunk; // of the rows a group
    uint groups;
    uint low_words; // 0: `low` may be anything
};

READ(0, real, values);
READ(1, real, x); // PAIRS: high and low word in turn, as b
WRITE(2, real, y);
#if DOT
WRITE(3, real, partials); // sums of x_i y_i
#elif RESIDUAL || PAIRS
READ(3, real, b);
#endif
#if PAIRS
READ(4, real, low);
#endif

#include "shared/row_terms.glsl"

SHARED(Term, sum, TAUT_LINEAR_GROUP);
#if DOT
SHARED(real, total, 1);
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    LANES_BEGIN(1)
    total[0] = real(0);
    LANES_END
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    for (uint row = begin; row < end; ++row)
    {
        PHASE_BEGIN
        sum[lane] = no_term();
        PHASE_END
        EACH_BEGIN(0u, count)
#if PAIRS
        sum[lane] = add_term(sum[lane], term(row * count + i, i));
#else
        sum[lane] += values[row * count + i] * x[i];
#endif
        EACH_END
        for (uint width = uint(TAUT_LINEAR_GROUP) / 2u; width > 0u; width /= 2u)
        {
            LANES_BEGIN(width)
            sum[lane] = add_term(sum[lane], sum[lane + width]);
            LANES_END
        }
        LANES_BEGIN(1)
        real result = row_result(row, sum[0]);
        y[row] = result;
#if DOT
        total[0] += x[row] * result;
#endif
        LANES_END
    }
#if DOT
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = total[0];
    LANES_END
#endif
}
