// The matrix of the aggregates: A_c = P^T A P, where P gives all vertices of an aggregate its translation. A
// block is the sum of the blocks that lead from one aggregate to another; one invocation makes it and its
// mirror image.
//
// Based on:
//   Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM 1987.
// Departures: diagonals are raised by 2^-14, so that no pivot is lost to rounding (src/linear/two_level.cpp).
// Bytes per block of A (float): 40 read.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // pairs of aggregates, each with itself or a later one
    uint chunk; // of them a group
    uint rows;  // of A_c
};

READ(0, uint, pair);   // three words a pair: the two aggregates, and where its blocks begin; then the end
READ(1, uint, block);  // where a block's first entry lies among the values; the next ones 32 further on
READ(2, real, values); // of A (shared/bcsr3.h)
WRITE(3, real, coarse);

real entry(uint first, uint end, uint at)
{
    real total = real(0);
    for (uint k = first; k < end; ++k)
        total += values[block[k] + 32u * at];
    return total;
}

void put(uint row, uint column, real value)
{
    real raised = row == column ? value + REAL(6.103515625e-5) * abs(value) : value;
    coarse[row * rows + column] = raised;
    coarse[column * rows + row] = raised;
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint at = 3u * uint(i);
    uint a = 3u * pair[at];
    uint b = 3u * pair[at + 1u];
    uint first = pair[at + 2u];
    uint last = pair[at + 5u];
    bool alone = a == b;
    for (uint r = 0u; r < 3u; ++r)
        for (uint c = alone ? r : 0u; c < 3u; ++c)
            put(a + r, b + c, entry(first, last, 3u * r + c));
    EACH_END
}
