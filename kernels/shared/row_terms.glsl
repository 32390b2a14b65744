// What a row of a product adds up, in one real or in two (PAIRS): for the kernels spmv_*. The kernel has
// declared `values`, `x`, with RESIDUAL `b`, and with PAIRS `b`, `low` and the parameter `low_words`. With
// TERMS_ONLY it needs no `b`, and takes care of the result itself.
//
// Based on: shared/two_float.glsl.
// Departures: none.
#ifndef TAUT_SHARED_ROW_TERMS_GLSL
#define TAUT_SHARED_ROW_TERMS_GLSL

#undef Term
#if PAIRS
#define Term TwoFloat

Term no_term() { return two_float(real(0), real(0)); }

Term term(uint entry, uint at)
{
    TwoFloat value = two_float(values[entry], real(0));
    if (low_words != 0u)
        value.low = low[entry];
    return two_float_multiply(value, two_float(x[2u * at], x[2u * at + 1u]));
}

Term add_term(Term a, Term b) { return two_float_add2(a, b); }

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

Term term(uint entry, uint at) { return values[entry] * x[at]; }

Term add_term(Term a, Term b) { return a + b; }

#if RESIDUAL
real row_result(uint row, Term sum) { return b[row] - sum; }
#else
real row_result(uint row, Term sum) { return sum; }
#endif
#endif

#endif
