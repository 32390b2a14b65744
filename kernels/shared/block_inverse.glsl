// Applying the inverse of 3 x 3 diagonal blocks: `inverse` holds six values a block row, xx xy xz yy yz zz. A
// diagonal value of 0 marks a held row.
//
// Based on:
//   Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, 12.2 (block Jacobi preconditioners).
// Departures: the inverses are formed once on the host (src/linear/preconditioner.cpp), held rows left out.
#ifndef TAUT_SHARED_BLOCK_INVERSE_GLSL
#define TAUT_SHARED_BLOCK_INVERSE_GLSL

rvec3 block_inverse_times(uint block, rvec3 r)
{
    uint at = 6u * block;
    real xy = inverse[at + 1u];
    real xz = inverse[at + 2u];
    real yz = inverse[at + 4u];
    return rvec3((inverse[at] * r.x + xy * r.y) + xz * r.z, (xy * r.x + inverse[at + 3u] * r.y) + yz * r.z,
                 (xz * r.x + yz * r.y) + inverse[at + 5u] * r.z);
}

/// Entries of held rows become 0.
rvec3 block_kept(uint block, rvec3 r)
{
    uint at = 6u * block;
    return rvec3(inverse[at] > real(0) ? r.x : real(0), inverse[at + 3u] > real(0) ? r.y : real(0),
                 inverse[at + 5u] > real(0) ? r.z : real(0));
}

#endif
