// After spmv_coo: rows that several groups made up, rows without entries, and what follows a product.
//
// Based on: Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented
//   Processors. SC 2009 (COO: segmented reduction with carries).
// Departures: carries are added in the order of groups, by a table made with the matrix.
// Bytes per row (float): dot 8 read; residual 8 read, 4 written; pairs 16 read, 4 written; else next to none.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint groups;
    uint splits; // rows made up by several groups
};

// groups + 1 numbers: where the rows of a group begin among the split ones; the same for the empty ones; then
// three words a split row: row, first and last group of its entries; then the empty rows.
READ(0, uint, table);
READ(1, real, carries); // as spmv_coo leaves them
#if PAIRS
GROUP_UPDATE(2, real, sums); // pairs
READ(3, real, b);            // pairs
WRITE(4, real, y);
#else
GROUP_UPDATE(2, real, y);
#if DOT
READ(3, real, x);
WRITE(4, real, partials);
#elif RESIDUAL
READ(3, real, b);
#endif
#endif

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint own = min(group, groups);
    uint next = min(group + 1u, groups);
    uint split_rows = 2u * (groups + 1u);
    uint empty_rows = split_rows + 3u * splits;
    EACH_BEGIN(table[own], table[next])
    uint row = table[split_rows + 3u * i];
    uint first = table[split_rows + 3u * i + 1u];
    uint last = table[split_rows + 3u * i + 2u];
#if PAIRS
    TwoFloat s = two_float(carries[2u * (groups + first)], carries[2u * (groups + first) + 1u]);
    for (uint k = first + 1u; k <= last; ++k)
        s = two_float_add2(s, two_float(carries[2u * k], carries[2u * k + 1u]));
    sums[2u * row] = s.high;
    sums[2u * row + 1u] = s.low;
#else
    real s = carries[groups + first];
    for (uint k = first + 1u; k <= last; ++k)
        s += carries[k];
    y[row] = s;
#endif
    EACH_END
    EACH_BEGIN(table[groups + 1u + own], table[groups + 1u + next])
    uint row = table[empty_rows + i];
#if PAIRS
    sums[2u * row] = real(0);
    sums[2u * row + 1u] = real(0);
#else
    y[row] = real(0);
#endif
    EACH_END
#if DOT || RESIDUAL || PAIRS
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
#if DOT
    CLEAR_LANES(sum)
#endif
    EACH_BEGIN(begin, end)
#if DOT
    sum[lane] += x[i] * y[i];
#elif RESIDUAL
    y[i] = b[i] - y[i];
#else
    TwoFloat product = two_float(sums[2u * i], sums[2u * i + 1u]);
    TwoFloat rest = two_float_add2(two_float(b[2u * i], b[2u * i + 1u]), two_float_negate(product));
    y[i] = rest.high + rest.low;
#endif
    EACH_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
#endif
}
