// Compressed rows: the rows of y = A x that are too long for one lane, a group a row. Comes before spmv_csr.
//
// Based on: Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented
//   Processors. SC 2009 (vector CSR).
// Departures: a whole group takes a row, because only rows of many hundred entries come here; the tree of
//   sums has one fixed order, so that the result repeats to the last bit.
// Bytes per entry (float): 8 read; pairs 12.
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/two_float.glsl"

PARAMS
{
    uint begin; // of the rows in `long_rows`
    uint end;
    uint groups; // that share them
    uint low_words; // PAIRS; 0: `low` may be anything
};

READ(0, uint, long_rows); // three words each: row, first entry, one behind the last
READ(1, uint, column);
READ(2, real, values);
READ(3, real, x); // PAIRS: high and low word in turn, as b
UPDATE(4, real, y);
#if RESIDUAL || PAIRS
READ(5, real, b);
#endif
#if PAIRS
READ(6, real, low);
#endif

#include "shared/row_terms.glsl"

SHARED(Term, sum, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint start = group < groups ? begin + group : end;
    for (uint k = start; k < end; k += groups)
    {
        PHASE_BEGIN
        sum[lane] = no_term();
        PHASE_END
        EACH_BEGIN(long_rows[3u * k + 1u], long_rows[3u * k + 2u])
        sum[lane] = add_term(sum[lane], term(i, column[i]));
        EACH_END
        for (uint width = uint(TAUT_LINEAR_GROUP) / 2u; width > 0u; width /= 2u)
        {
            LANES_BEGIN(width)
            sum[lane] = add_term(sum[lane], sum[lane + width]);
            LANES_END
        }
        LANES_BEGIN(1)
        uint row = long_rows[3u * k];
        y[row] = row_result(row, sum[0]);
        LANES_END
    }
}
