// ELLPACK: y = A x with every row padded to the same number of entries, stored column by column, so that
// neighbouring lanes read neighbouring memory.
//
// Based on:
//   Grimes, Kincaid, Young. ITPACK 2.0 User's Guide. 1979. (the format)
//   Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented Processors. SC
//   2009
// Departures: none. Padding is value 0 in the row's own column.
// Bytes per stored entry (float): 8 read; per row 4 read (8 with b), 4 written; pairs 12 and 16.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"

PARAMS
{
    uint count;  // rows
    uint chunk;  // of them a group
    uint groups;
    uint stride; // entries from one column of storage to the next: rows and padding
    uint width;  // entries a row
    uint low_words; // PAIRS; 0: `low` may be anything
};

READ(0, uint, column); // stride * width
READ(1, real, values);
READ(2, real, x); // PAIRS: high and low word in turn, as b
WRITE(3, real, y);
#if DOT
WRITE(4, real, partials); // sums of x_i y_i
#elif RESIDUAL || PAIRS
READ(4, real, b);
#endif
#if PAIRS
READ(5, real, low);
#endif

#include "shared/row_terms.glsl"

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif
DECLARE(void add_rows(uint begin, uint end))

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    add_rows(begin, end);
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}

APART void add_rows(uint begin, uint end)
{
    EACH_BEGIN(begin, end)
    uint at = uint(i);
    Term s = no_term();
    for (uint k = 0u; k < width; ++k)
    {
        s = add_term(s, term(at, column[at]));
        at += stride;
    }
    real result = row_result(i, s);
    y[i] = result;
#if DOT
    sum[lane] += x[i] * result;
#endif
    EACH_END
}
