// What position-based dynamics does to a constraint, for its coloured and its Jacobi kernels:
//   dx_i = -k' C w_i grad_i C / sum w_j |grad_j C|^2.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006 / JVCIR 18(2),
//   2007: eqs. 4 and 5.
// Departures: `share` is the part of a correction that one iteration makes, k' = 1 - (1 - k)^(1/n); the
//   element's divisor goes into the one division; elements with bounds are held back (bounded_push).
#ifndef TAUT_SHARED_PBD_GLSL
#define TAUT_SHARED_PBD_GLSL

#include "shared/element.glsl"

/// The displacement of corner i per inverse mass, kg m: g_i of the row times `scale`.
struct RowPush
{
    real scale; // 0 where it is not usable
    rbool usable;
};

/// `weight`: row_weight of the inverse masses of the corners, 1/kg.
INLINE RowPush row_push(ElementRow row, real weight, real share)
{
    RowPush push;
    real denominator = weight * row.divisor;
    // Held vertices alone may carry the gradient; smaller would overflow.
    push.usable = row.shaped && denominator > REAL(1e-30);
    real scale = -row.value * share / SELECT(push.usable, denominator, real(1));
    push.scale = SELECT(push.usable, scale, real(0));
    return push;
}

/// A nearly collapsed tetrahedron has hardly a gradient and would be thrown far beyond the body: its corners
/// go no further at once than the longest edge from its first corner, so that it grows back over several
/// iterations. For elements of four corners `with bounds`. w0..w3: inverse masses, 1/kg.
INLINE RowPush bounded_push(RowPush wanted, ElementRow row, real w0, real w1, real w2, real w3,
                            rvec3 e1, rvec3 e2, rvec3 e3)
{
    RowPush push;
    // Squares, since drivers have an instruction of their own for a quotient by a root.
    real fastest = max(max((w0 * w0) * row.s0, (w1 * w1) * row.s1),
                       max((w2 * w2) * row.s2, (w3 * w3) * row.s3)) * (row.divisor * row.divisor);
    real reach = max(dot(e1, e1), max(dot(e2, e2), dot(e3, e3)));
    push.usable = wanted.usable && fastest > REAL(1e-30); // smaller would overflow
    real limit = sqrt(reach / SELECT(push.usable, fastest, real(1)));
    push.scale = SELECT(push.usable, min(max(wanted.scale, -limit), limit), real(0));
    return push;
}

#endif
