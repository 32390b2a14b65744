// The inverse that conjugate gradients precondition with, formed from the values of a matrix that were
// rewritten on the device: 1 / a_ii a row, or with BLOCK the inverse of each 3 x 3 block on the diagonal (of
// the mean of mirrored entries, without held rows and columns). Held rows get 0, as their mark. A diagonal
// that no inverse serves (0, infinite, NaN) gets 1, a negative one 1 / |a_ii|: then it is the products with
// the matrix that show what it is. A kernel cannot refuse.
//
// Based on: Higham. Accuracy and Stability of Numerical Algorithms, 2nd ed. 2002, 10.1 (L D L^T of a block
//   scaled to a unit diagonal).
// Departures: a block nearly singular for the rounding of a real is shifted, as block_jacobi_inverse
//   (src/linear/preconditioner.cpp) does; one that is not positive definite even so gives its diagonal alone.
// Bytes per row (float): 12 read, 4 written; with BLOCK 28 and 8.
//! variant block BLOCK=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // rows; with BLOCK block rows
    uint chunk; // of them a group
};

READ(0, real, values);
READ(1, uint, slots);    // one a row; with BLOCK nine a block, row by row; 0xffffffff: a zero, not stored
READ(2, uint, held);     // one a row; not 0: held
WRITE(3, real, inverse); // one a row; with BLOCK six a block: xx xy xz yy yz zz

real entry(uint k)
{
    uint slot = slots[k];
    bool stored = slot != 0xffffffffu;
    real value = values[stored ? slot : 0u];
    return stored ? value : real(0);
}

real inverse_of(real d)
{
    real m = real(1) / abs(d);
    return d != real(0) && m > real(0) ? min(m, REAL(3.4e38)) : real(1);
}

#if BLOCK
// PRECISE: drivers would rearrange products, and executors differ in the last bit.
// Of a block whose diagonal is `diagonal` throughout: pivots and the entries of the inverse of L.
struct Factors
{
    real pivot1;
    real pivot2;
    real l10;
    real l20;
    real l21;
};

Factors factors_of(real xy, real xz, real yz, real diagonal)
{
    Factors f;
    PRECISE real f10 = xy / diagonal;
    PRECISE real f20 = xz / diagonal;
    PRECISE real rest = yz - f20 * xy;
    PRECISE real pivot1 = diagonal - f10 * xy;
    PRECISE real f21 = rest / pivot1;
    PRECISE real pivot2 = (diagonal - f20 * xz) - f21 * rest;
    PRECISE real l20 = f10 * f21 - f20;
    f.pivot1 = pivot1;
    f.pivot2 = pivot2;
    f.l10 = -f10;
    f.l21 = -f21;
    f.l20 = l20;
    return f;
}

// 64 rounding units.
real least_eigenvalue()
{
#if TAUT_REAL_DOUBLE
    return REAL(7.105427357601002e-15);
#else
    return REAL(3.814697265625e-6);
#endif
}

// 0 for a held row alone: where tiny numbers are flushed to 0, a row must not be taken for held.
real kept(uint row, real value)
{
#if TAUT_REAL_DOUBLE
    real least = REAL(2.3e-308);
#else
    real least = REAL(1.2e-38);
#endif
    return held[row] != 0u ? real(0) : max(value, least);
}

void put(uint block, real xx, real xy, real xz, real yy, real yz, real zz)
{
    inverse[6u * block] = kept(3u * block, xx);
    inverse[6u * block + 1u] = xy;
    inverse[6u * block + 2u] = xz;
    inverse[6u * block + 3u] = kept(3u * block + 1u, yy);
    inverse[6u * block + 4u] = yz;
    inverse[6u * block + 5u] = kept(3u * block + 2u, zz);
}

void invert(uint block)
{
    uint at = 9u * block;
    real dx = entry(at), dy = entry(at + 4u), dz = entry(at + 8u);
    bool no_x = held[3u * block] != 0u || dx == real(0);
    bool no_y = held[3u * block + 1u] != 0u || dy == real(0);
    bool no_z = held[3u * block + 2u] != 0u || dz == real(0);
    dx = no_x ? real(1) : dx;
    dy = no_y ? real(1) : dy;
    dz = no_z ? real(1) : dz;
    PRECISE real rx = real(1) / sqrt(abs(dx));
    PRECISE real ry = real(1) / sqrt(abs(dy));
    PRECISE real rz = real(1) / sqrt(abs(dz));
    PRECISE real xy = no_x || no_y ? real(0) : real(0.5) * (entry(at + 1u) + entry(at + 3u)) * rx * ry;
    PRECISE real xz = no_x || no_z ? real(0) : real(0.5) * (entry(at + 2u) + entry(at + 6u)) * rx * rz;
    PRECISE real yz = no_y || no_z ? real(0) : real(0.5) * (entry(at + 5u) + entry(at + 7u)) * ry * rz;
    real diagonal = real(1);
    Factors f = factors_of(xy, xz, yz, diagonal);
    bool regular = f.pivot1 > real(0) && f.pivot2 > real(0);
    // The smallest eigenvalue is at least 4/9 of the determinant, because the three add up to 3.
    if (!regular || REAL(0.4444444444444444) * (f.pivot1 * f.pivot2) < least_eigenvalue())
    {
        diagonal += least_eigenvalue();
        f = factors_of(xy, xz, yz, diagonal);
        regular = f.pivot1 > real(0) && f.pivot2 > real(0);
    }
    bool positive = dx > real(0) && dy > real(0) && dz > real(0);
    bool finite = rx > real(0) && ry > real(0) && rz > real(0);
    if (!(regular && positive && finite))
    {
        put(block, inverse_of(dx), real(0), real(0), inverse_of(dy), real(0), inverse_of(dz));
        return;
    }
    PRECISE real d0 = real(1) / diagonal;
    PRECISE real d1 = real(1) / f.pivot1;
    PRECISE real d2 = real(1) / f.pivot2;
    PRECISE real ixx = (rx * rx) * (d0 + (f.l10 * f.l10 * d1 + f.l20 * f.l20 * d2));
    PRECISE real ixy = (rx * ry) * (f.l10 * d1 + f.l20 * f.l21 * d2);
    PRECISE real ixz = (rx * rz) * (f.l20 * d2);
    PRECISE real iyy = (ry * ry) * (d1 + f.l21 * f.l21 * d2);
    PRECISE real iyz = (ry * rz) * (f.l21 * d2);
    PRECISE real izz = (rz * rz) * d2;
    put(block, ixx, ixy, ixz, iyy, iyz, izz);
}
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
#if BLOCK
    invert(uint(i));
#else
    inverse[i] = held[i] != 0u ? real(0) : inverse_of(entry(uint(i)));
#endif
    EACH_END
}
