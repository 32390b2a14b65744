// What a row of a product adds up, in one real or in two (PAIRS): for the kernels spmv_*. The kernel has
// declared `values`, `x`, with RESIDUAL `b`, and with PAIRS `b`, `low` and the parameter `low_words`. With
// TERMS_ONLY it needs no `b`, and takes care of the result itself.
//
// For kernels of SLICES, sums of all rows of a slice: ROW_SUM(s) declares one, CLEAR_ROW_SUM(s) is for
// SLICE_ROWS, ADD_TO_ROW_SUM(s, entry, at) for SLICE_STEPS, ROW_TERM(s) is the Term. Pairs are fetched in a
// loop of their own, so that the CPU adds for several rows at once.
//
// Based on: shared/two_float.glsl.
// Departures: none.
#ifndef TAUT_SHARED_ROW_TERMS_GLSL
#define TAUT_SHARED_ROW_TERMS_GLSL

#undef Term
#undef ROW_SUM
#undef CLEAR_ROW_SUM
#undef ADD_TO_ROW_SUM
#undef ROW_TERM
#if PAIRS
#define Term TwoFloat

Term no_term() { return two_float(real(0), real(0)); }

Term term(WIDE entry, WIDE at)
{
    TwoFloat value = two_float(values[entry], real(0));
    if (low_words != 0u)
        value.low = low[entry];
    return two_float_multiply(value, two_float(x[2u * at], x[2u * at + 1u]));
}

Term add_term(Term a, Term b) { return two_float_add2(a, b); }

#define ROW_SUM(s)                 \
    PER_ROW(real, s##_high);       \
    PER_ROW(real, s##_low);        \
    PER_ROW(real, s##_value);      \
    PER_ROW(real, s##_value_low);  \
    PER_ROW(real, s##_x);          \
    PER_ROW(real, s##_x_low)
#define CLEAR_ROW_SUM(s)           \
    ROW(s##_high) = real(0);       \
    ROW(s##_low) = real(0);        \
    ROW(s##_value_low) = real(0)
#define ADD_TO_ROW_SUM(s, entry, at)                                                          \
    ROW(s##_value) = values[entry];                                                           \
    if (low_words != 0u)                                                                      \
        ROW(s##_value_low) = low[entry];                                                      \
    ROW(s##_x) = x[2u * (at)];                                                                \
    ROW(s##_x_low) = x[2u * (at) + 1u];                                                       \
    SLICE_ROWS_END                                                                            \
    SLICE_ROWS_BEGIN                                                                          \
    TwoFloat taut_term = two_float_multiply(two_float(ROW(s##_value), ROW(s##_value_low)),    \
                                            two_float(ROW(s##_x), ROW(s##_x_low)));           \
    TwoFloat taut_sum = two_float_add2(two_float(ROW(s##_high), ROW(s##_low)), taut_term);    \
    ROW(s##_high) = taut_sum.high;                                                            \
    ROW(s##_low) = taut_sum.low
#define ROW_TERM(s) two_float(ROW(s##_high), ROW(s##_low))

#if !TERMS_ONLY
/// b - sum, rounded to one real.
real row_result(uint row, Term sum)
{
    TwoFloat result = two_float_add2(two_float(b[2u * row], b[2u * row + 1u]), two_float_negate(sum));
    return result.high + result.low;
}
#endif
#else
#define Term real

Term no_term() { return real(0); }

Term term(WIDE entry, WIDE at) { return values[entry] * x[at]; }

Term add_term(Term a, Term b) { return a + b; }

#define ROW_SUM(s) PER_ROW(real, s)
#define CLEAR_ROW_SUM(s) ROW(s) = real(0)
#define ADD_TO_ROW_SUM(s, entry, at) ROW(s) = ROW(s) + values[entry] * x[at]
#define ROW_TERM(s) ROW(s)

#if RESIDUAL
real row_result(uint row, Term sum) { return b[row] - sum; }
#else
real row_result(uint row, Term sum) { return sum; }
#endif
#endif

#endif
