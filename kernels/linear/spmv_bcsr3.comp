// 3 x 3 blocks in slices of 32 block rows (shared/bcsr3.h): y = A x, a lane a block row.
//
// Based on:
//   Monakov, Lokhmotov, Avetisyan. Automatically Tuning Sparse Matrix-Vector Multiplication for GPU
//   Architectures. HiPEAC 2010 (sliced ELLPACK), with blocks for entries.
// Departures: none.
// Bytes per block (float): 40 read, 76 with low words; per block row 24 (with b 36).
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"
#include "shared/bcsr3.h"

PARAMS
{
    uint count; // block rows
    uint chunk; // of them a group, a multiple of 32
    uint groups;
    uint low_words; // 0: `low` may be anything
};

READ(0, uint, slice_start); // in steps
READ(1, uint, column);      // of blocks
READ(2, real, values);
READ(3, real, x); // PAIRS: high and low word in turn, as b
WRITE(4, real, y);
#if DOT
WRITE(5, real, partials); // sums of x_i y_i
#elif RESIDUAL || PAIRS
READ(5, real, b);
#endif
#if PAIRS
READ(6, real, low);
#endif

#include "shared/row_terms.glsl"

#undef ENTRY
#if PAIRS
#define ENTRY(e, at) term(uint(TAUT_BCSR3_VALUE(start + k, e, r)), at)
#else
#define ENTRY(e, at) (values[TAUT_BCSR3_VALUE(start + k, e, r)] * x[at])
#endif
#define THREE(sum, e) \
    add_term(add_term(add_term(sum, ENTRY(e, c)), ENTRY(e + 1u, c + 1u)), ENTRY(e + 2u, c + 2u))

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
    uint start = slice_start[slice];
    uint steps = slice_start[slice + 1u] - start;
    PER_ROW(Term, sum0);
    PER_ROW(Term, sum1);
    PER_ROW(Term, sum2);
    SLICE_ROWS_BEGIN
    ROW(sum0) = no_term();
    ROW(sum1) = no_term();
    ROW(sum2) = no_term();
    SLICE_ROWS_END
    SLICE_STEPS_BEGIN(steps)
    uint c = 3u * column[TAUT_BCSR3_BLOCK(start + k, r)];
    ROW(sum0) = THREE(ROW(sum0), 0u);
    ROW(sum1) = THREE(ROW(sum1), 3u);
    ROW(sum2) = THREE(ROW(sum2), 6u);
    SLICE_STEPS_END
    SLICE_ROWS_BEGIN
    uint i = slice * 32u + r;
    if (i < count)
    {
        real y0 = row_result(3u * i, ROW(sum0));
        real y1 = row_result(3u * i + 1u, ROW(sum1));
        real y2 = row_result(3u * i + 2u, ROW(sum2));
        y[3u * i] = y0;
        y[3u * i + 1u] = y1;
        y[3u * i + 2u] = y2;
#if DOT
        sum[lane] += (x[3u * i] * y0 + x[3u * i + 1u] * y1) + x[3u * i + 2u] * y2;
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
