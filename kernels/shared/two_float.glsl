// Numbers as an unevaluated sum of two reals (high + low, |low| <= ulp(high) / 2): about twice the digits
// without wider types and without fma, which Mesa's drivers do not fuse. PRECISE forbids the compiler to
// rearrange; the native build keeps products and sums apart (-ffp-contract=off).
//
// Based on:
//   Dekker. A floating-point technique for extending the available precision. 1971. (split, two_product)
//   Knuth. The Art of Computer Programming 2, 4.2.2, theorem B. (two_sum)
// Departures: none. Products overflow from 2^115 (float) and 2^996 (double) on, as Dekker's split does.
#ifndef TAUT_SHARED_TWO_FLOAT_GLSL
#define TAUT_SHARED_TWO_FLOAT_GLSL

struct TwoFloat
{
    real high;
    real low;
};

TwoFloat two_float(real high, real low)
{
    TwoFloat pair;
    pair.high = high;
    pair.low = low;
    return pair;
}

/// Splits the digits of a number in two halves: 2^27 + 1 or 2^12 + 1.
real two_float_splitter()
{
#if TAUT_REAL_DOUBLE
    return real(134217729);
#else
    return real(4097);
#endif
}

TwoFloat two_sum(real a, real b)
{
    PRECISE real sum = a + b;
    PRECISE real part = sum - a;
    PRECISE real low = (a - (sum - part)) + (b - part);
    return two_float(sum, low);
}

/// Where |a| >= |b|, or a = 0.
TwoFloat two_sum_ordered(real a, real b)
{
    PRECISE real sum = a + b;
    PRECISE real low = b - (sum - a);
    return two_float(sum, low);
}

/// Where the native build has a wider type (WIDER_PRODUCT), it gives the same two numbers sooner.
TwoFloat two_product(real a, real b)
{
#ifdef WIDER_PRODUCT
    TwoFloat exact;
    if (WIDER_PRODUCT(a, b, exact.high, exact.low))
        return exact;
#endif
    PRECISE real product = a * b;
    PRECISE real ta = two_float_splitter() * a;
    PRECISE real tb = two_float_splitter() * b;
    PRECISE real ah = ta - (ta - a);
    PRECISE real bh = tb - (tb - b);
    PRECISE real al = a - ah;
    PRECISE real bl = b - bh;
    PRECISE real low = ((ah * bh - product) + ah * bl + al * bh) + al * bl;
    return two_float(product, low);
}

TwoFloat two_float_add(TwoFloat a, real b)
{
    TwoFloat sum = two_sum(a.high, b);
    PRECISE real low = sum.low + a.low;
    return two_sum_ordered(sum.high, low);
}

TwoFloat two_float_add2(TwoFloat a, TwoFloat b)
{
    TwoFloat sum = two_sum(a.high, b.high);
    PRECISE real low = sum.low + (a.low + b.low);
    return two_sum_ordered(sum.high, low);
}

/// a * b without the product of the low parts, which is below the last digit kept.
TwoFloat two_float_multiply(TwoFloat a, TwoFloat b)
{
    TwoFloat product = two_product(a.high, b.high);
    PRECISE real low = product.low + (a.high * b.low + a.low * b.high);
    return two_sum_ordered(product.high, low);
}

TwoFloat two_float_negate(TwoFloat a)
{
    return two_float(-a.high, -a.low);
}

#endif
