// The product A = J W J^T + compliance of implicit constraints, entry by entry, where some rows have four
// corners: an entry is the sum of w_k g_r . g_c over the vertices k that its two rows share, each with the
// gradients that the rows have there. One invocation per entry, terms in their order.
//
// Based on: Va, Choi, Hong, as constraint_matrix.
// Departures: none beyond those of constraint_matrix.
// Bytes per entry (float): 8 read, 4 written; per term 12 + 32 read, 32 more where a gradient is that of a
//   first corner.
#include "shared/portable.glsl"
#include "shared/corner_address.h"

PARAMS
{
    uint count; // entries
};

READ(0, uint, start);     // entries + 1: terms of each
READ(1, uint, term);      // two a term: addresses of the gradients of row and column
READ(2, real, weight);    // 1/kg a term
READ(3, rvec4, direction); // a row of springs; w = what compliance adds to the diagonal
READ(4, rvec4, gradient);  // 3 a row of four corners, the first w likewise
WRITE(5, real, values);

/// The gradient of a first corner is what the others leave.
rvec3 gradient_at(uint address)
{
    if ((address & TAUT_CORNER_ROW) == 0u)
    {
        rvec3 n = rvec3(direction[address >> 1u]);
        return (address & 1u) == 0u ? n : -n;
    }
    uint corner = address & 3u;
    uint at = 3u * ((address & ~TAUT_CORNER_ROW) >> 2u);
    if (corner != 0u)
        return rvec3(gradient[at + corner - 1u]);
    return -((rvec3(gradient[at]) + rvec3(gradient[at + 1u])) + rvec3(gradient[at + 2u]));
}

KERNEL(count)
{
    uint first = start[i];
    uint last = start[i + 1u];
    real sum = real(0);
    for (uint k = first; k < last; ++k)
    {
        PRECISE real product = weight[k] * dot(gradient_at(term[2u * k]), gradient_at(term[2u * k + 1u]));
        sum += product;
    }
    // On the diagonal, and only there, a term's two gradients are one.
    uint address = term[2u * first];
    bool diagonal = address == term[2u * first + 1u];
    bool corners = (address & TAUT_CORNER_ROW) != 0u;
    uint row = corners ? 3u * ((address & ~TAUT_CORNER_ROW) >> 2u) : address >> 1u;
    if (diagonal)
        sum += corners ? gradient[row].w : direction[row].w;
    values[i] = sum;
}
