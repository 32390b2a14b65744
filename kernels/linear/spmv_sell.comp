// SELL-C-sigma: y = A x with rows in slices of 32, each padded to its own longest row and stored column by
// column; rows were sorted by length within windows of 256, so that a slice's rows are about as long.
//
// Based on: Kreutzer, Hager, Wellein, Fehske, Bishop. A Unified Sparse Matrix Data Format for Efficient
//   General Sparse Matrix-Vector Multiplication on Modern Processors with Wide SIMD Units. SISC 2014.
// Departures: y keeps the order of the matrix; only the storage is sorted.
// Bytes per stored entry (float): 8 read; per row 8 read (12 with b), 4 written; pairs 12 and 20.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // places, one a row
    uint chunk; // of them a group, a multiple of 32
    uint groups;
    uint low_words; // PAIRS; 0: `low` may be anything
};

READ(0, uint, slice_start); // slices + 1, in entries
READ(1, uint, order);       // the row that stands at each place
READ(2, uint, column);
READ(3, real, values);
READ(4, real, x); // PAIRS: high and low word in turn, as b
WRITE(5, real, y);
#if DOT
WRITE(6, real, partials); // sums of x_i y_i
#elif RESIDUAL || PAIRS
READ(6, real, b);
#endif
#if PAIRS
READ(7, real, low);
#endif

#include "shared/row_terms.glsl"

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
    SLICES_BEGIN((begin + 31u) / 32u, (end + 31u) / 32u) // an empty group has begin = end = count
    uint first = slice_start[slice];
    uint steps = (slice_start[slice + 1u] - first) / 32u;
    ROW_SUM(s);
    SLICE_ROWS_BEGIN
    CLEAR_ROW_SUM(s);
    SLICE_ROWS_END
    SLICE_STEPS_BEGIN(steps)
    ADD_TO_ROW_SUM(s, first + 32u * k + r, column[first + 32u * k + r]);
    SLICE_STEPS_END
    SLICE_ROWS_BEGIN
    uint i = slice * 32u + uint(r);
    if (i < count)
    {
        uint row = order[i];
        real result = row_result(row, ROW_TERM(s));
        y[row] = result;
#if DOT
        sum[lane] += x[row] * result;
#endif
    }
    SLICE_ROWS_END
    SLICES_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}
