// One pivot k of the inversion of a symmetric matrix by sweeps; after all of them -A^-1 is left:
//   a_kk <- -1 / a_kk,   a_ik <- a_ik / a_kk,   a_ij <- a_ij - a_ik a_kj / a_kk.
// A row whose pivot is not positive is left out: its row and column become 0, and the others' inverse is that
// of the matrix without it.
//
// Based on:
//   Goodnight. A Tutorial on the SWEEP Operator. The American Statistician 33(3), 1979.
// Departures: from one buffer into another, so that no entry waits for another; the product comes before the
//   quotient, so that the result is symmetric to the last bit.
// Bytes per entry (float): 8 read, 4 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // rows and columns
    uint chunk; // of the rows a group
    uint pivot; // k
};

READ(0, real, before);
WRITE(1, real, after);

real swept(uint row, uint column, real along, real inverse)
{
    real other = before[pivot * count + column];
    PRECISE real product = along * other;
    PRECISE real less = before[row * count + column] - product * inverse;
    PRECISE real across = (row == pivot ? other : along) * inverse;
    bool on_both = row == pivot && column == pivot;
    real on_cross = on_both ? -inverse : across;
    return row == pivot || column == pivot ? on_cross : less;
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    real lead = before[pivot * count + pivot];
    real quotient = real(1) / lead;
    real inverse = lead > real(0) && IS_FINITE(quotient) ? quotient : real(0);
    for (uint row = begin; row < end; ++row)
    {
        real along = before[row * count + pivot];
        EACH_BEGIN(0u, count)
        after[row * count + i] = swept(row, uint(i), along, inverse);
        EACH_END
    }
}
