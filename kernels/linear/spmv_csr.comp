// Compressed rows: y = A x for rows that are short; spmv_csr_long has done the others before.
//
// Based on:
//   Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented Processors. SC
//   2009 (scalar CSR).
//   Greathouse, Daga. Efficient Sparse Matrix-Vector Multiplication on GPUs using the CSR Storage Format.
//   SC 2014 (variants "stream": products go to shared memory in the order of memory, then a lane sums a row).
// Departures: a window is always a row a lane and passes through shared memory in pieces, so nothing but
//   row_start is stored; both ways add a row from left to right, so that they agree to the last bit.
// A row of no entries here is one that spmv_csr_long has written. A row that is empty in truth holds one
// zero.
// Bytes per entry (float): 8 read; per row 8 read (12 with b), 4 written; pairs 12 and 20.
//! variant dot DOT=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
//! variant stream STREAM=1
//! variant stream_dot STREAM=1 DOT=1
//! variant stream_residual STREAM=1 RESIDUAL=1
//! variant stream_residual_pairs STREAM=1 PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group, a multiple of 32
    uint groups;
    uint low_words; // PAIRS; 0: `low` may be anything
};

READ(0, uint, row_start); // count + 1, all below 2^31
READ(1, uint, column);
READ(2, real, values);
READ(3, real, x); // PAIRS: high and low word in turn, as b
UPDATE(4, real, y);
#if DOT
WRITE(5, real, partials); // sums of x_i y_i
#elif RESIDUAL || PAIRS
READ(5, real, b);
#endif
#if PAIRS
READ(6, real, low);
#endif

#include "shared/row_terms.glsl"

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif
#undef PIECE
#if STREAM
#if PAIRS
#define PIECE 512u
#else
#define PIECE 1024u
#endif
SHARED(Term, terms, PIECE);
SHARED(Term, row_sum, TAUT_LINEAR_GROUP);
#endif

#undef AHEAD
#define AHEAD 512u // entries

#if !STREAM
DECLARE(void add_rows(uint begin, uint end))
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
#if STREAM
    for (uint base = begin; base < end; base += uint(TAUT_LINEAR_GROUP))
    {
        uint last = min(base + uint(TAUT_LINEAR_GROUP), end);
        uint from = row_start[base];
        uint to = row_start[last];
        // Once at least: rows of no entries are counted in the first piece.
        for (uint piece = from; piece == from || piece < to; piece += PIECE)
        {
            uint stop = min(piece + PIECE, to);
            EACH_BEGIN(piece, stop)
            terms[i - piece] = term(i, column[i]);
            EACH_END
            EACH_BEGIN(base, last)
            uint first = row_start[i];
            uint after = row_start[i + 1u];
            Term s = no_term();
            if (first < piece)
                s = row_sum[lane]; // of the pieces before
            uint upto = min(after, stop);
            for (uint k = max(first, piece); k < upto; ++k)
                s = add_term(s, terms[k - piece]);
            row_sum[lane] = s;
            bool ends = first < after && after > piece && after <= stop;
            if (ends)
                y[i] = row_result(i, s);
#if DOT
            if (ends || (first == after && piece == from))
                sum[lane] += x[i] * y[i];
#endif
            EACH_END
        }
    }
#else
    add_rows(begin, end);
#endif
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}

#if PAIRS && !STREAM
// Slices of 32 rows make the steps that all of them have together; on devices each row makes its own.
APART void add_rows(uint begin, uint end)
{
    SLICES_BEGIN((begin + 31u) / 32u, (end + 31u) / 32u)
    PER_ROW(WIDE, first);
    PER_ROW(WIDE, after);
    ROW_SUM(s);
    WIDE steps = 0xffffffffu;
    SLICE_ROWS_BEGIN
    WIDE i = min(slice * 32u + uint(r), count - 1u);
    ROW(first) = row_start[i];
    ROW(after) = row_start[i + 1u];
    CLEAR_ROW_SUM(s);
    steps = min(steps, ROW(after) - ROW(first));
    SLICE_ROWS_END
    SLICE_STEPS_BEGIN(steps)
    ADD_TO_ROW_SUM(s, ROW(first) + k, column[ROW(first) + k]);
    SLICE_STEPS_END
    SLICE_ROWS_BEGIN
    uint i = slice * 32u + uint(r);
    if (i < count && ROW(first) < ROW(after))
    {
        Term sum = ROW_TERM(s);
        for (WIDE k = ROW(first) + steps; k < ROW(after); ++k)
            sum = add_term(sum, term(k, column[k]));
        y[i] = row_result(i, sum);
    }
    SLICE_ROWS_END
    SLICES_END
}
#elif !STREAM
#undef ADD_TWO_ENTRIES
#define ADD_TWO_ENTRIES(s, k) ADD_TWO(s, values, k, x[column[k]], x[column[(k) + 1u]])

APART void add_rows(uint begin, uint end)
{
    EACH_BEGIN(begin, end)
    WIDE k = row_start[i];
    WIDE after = row_start[i + 1u];
    if (k < after)
    {
        Term s = no_term();
        for (; k + 8u <= after; k += 8u)
        {
            PREFETCH(values, k + AHEAD);
            PREFETCH(column, k + AHEAD);
            ADD_TWO_ENTRIES(s, k);
            ADD_TWO_ENTRIES(s, k + 2u);
            ADD_TWO_ENTRIES(s, k + 4u);
            ADD_TWO_ENTRIES(s, k + 6u);
        }
        PREFETCH(values, k + AHEAD);
        PREFETCH(column, k + AHEAD);
        if (k + 4u <= after)
        {
            ADD_TWO_ENTRIES(s, k);
            ADD_TWO_ENTRIES(s, k + 2u);
            k += 4u;
        }
        if (k + 2u <= after)
        {
            ADD_TWO_ENTRIES(s, k);
            k += 2u;
        }
        if (k < after)
            s = add_term(s, term(k, column[k]));
        y[i] = row_result(i, s);
    }
#if DOT
    sum[lane] += x[i] * y[i];
#endif
    EACH_END
}
#endif
