// XPBD stable neo-Hookean tetrahedron, one invocation per tetrahedron of one colour (no two share a vertex).
//
// Based on:
//   Macklin, Mueller. A Constraint-based Formulation of Stable Neo-Hookean Materials. MIG 2021: the material
//     of a tetrahedron as two constraints with compliances 1/(mu V), 1/(lambda V).
//   Smith, de Goes, Kim. Stable Neo-Hookean Flesh Simulation. 2018: the energy.
// Departures: the two constraints are others, zero at rest, and are the same energy
//   (docs/theory/xpbd-solids.md): C_H = J - 1, J = det F, with Lame's lambda, and
//   C_D = sqrt(2 (Psi - lambda/2 (J - 1)^2) / mu), real for every F. |F| and J - rest, which balance at rest
//   only by their multipliers, move a stiff body on which nothing acts. Both are solved together. The
//   gradient of C_D is taken times C_D, so that nothing divides by it, and less its part along that of C_H,
//   so that the determinant is a sum of positive terms: where a shape only grows the two are parallel, and
//   the difference of their products would have no digit left. A step that would change F by more than
//   max(|F|, sqrt 3) is shortened to that (docs/decisions.md, 76).
// Bytes per element: 72 constraint + 128 read + 64 written (float).
//! lanes
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/solid.glsl"

PARAMS
{
    uint first;           // first constraint of the colour; in the tail variant the table's first range
    uint count;           // constraints of the colour; groups in the tail variant
    uint first_iteration; // 1: the multipliers start at zero
    uint report;          // 1: count degenerate tetrahedra
};

READ(0, SolidTetrahedron, constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(5, uint, table);          // as in xpbd.comp
#else
UPDATE(2, rvec4, delta);
#endif
#if LAMBDA
#if TAIL
UPDATE(6, rvec4, multiplier); // x of C_D, y of C_H, J s^2
#else
UPDATE(5, rvec4, multiplier);
#endif
#endif

/// C_D over `size`, squared, and C_D times its gradient by F over `size`, by columns.
struct Rows
{
    rvec3 r0, r1, r2;
    real square;
    real size;   // 1, and |J - 1| where that is more, so that squares stay finite
    real grown;  // C_H
    real lambda; // Pa: of C_H
};

/// Psi / (mu/2) = slope (a - j) + curve j^2 + log (x - ln(1 + x)) + lambda/mu j^2 with j = J - 1,
/// a = (|F|^2 - 3) / 2, x = a/2. c0, c1, c2: the cofactors of F.
Rows rows_of(SolidTetrahedron t, Deformation f, rvec3 c0, rvec3 c1, rvec3 c2)
{
    real slope = real(2) - real(0.5) * t.log_term;
    real curve = real(1) - real(0.375) * t.log_term;
    real spare = t.lambda - curve * t.mu;
    curve += min(spare, real(0)) / t.mu; // a negative Poisson's ratio: no compliance for C_H, all is in C_D
    real j = f.volume - real(1);
    Rows o;
    o.grown = j;
    o.lambda = max(spare, real(0));
    o.size = max(abs(j), real(1));
    real over = real(1) / o.size;
    real across = f.share * over;
    real along = (curve * j - real(0.5) * slope) * over;
    o.r0 = f.f0 * across + c0 * along;
    o.r1 = f.f1 * across + c1 * along;
    o.r2 = f.f2 * across + c2 * along;
    // C_D cancels against its gradient wherever forces balance: it says how far a step goes. So it may be
    // approximate: x - ln(1 + x) is its Pade approximant, to 4 % (no two executors have the same logarithm);
    // near rest, where the sum is a difference of equal terms and its root would be 3e-4 in float, it is what
    // the gradient makes it to first order in the strain; and where the gradient is small far from rest, as
    // in a collapsed tetrahedron, it is no more than that: a step from there leads anywhere.
    real steep = (dot(o.r0, o.r0) + dot(o.r1, o.r1)) + dot(o.r2, o.r2);
    real a = real(0.5) * (f.square - real(3));
    real x = real(0.5) * a;
    real bow = (x * (real(3) + x)) / ((real(6) + real(6) * x) + x * x);
    real part = j * over;
    real plain = ((slope * (a - j) + t.log_term * (x * bow)) * over) * over + curve * (part * part);
    real mild = steep * (real(0.5) + t.log_term * REAL(0.16666666666666666667)); // steep / slope
    o.square = SELECT(steep < REAL(1e-3), mild, min(plain, steep));
    return o;
}

/// How much of a step is taken that moves the edges by these: min(1, max(|F|, sqrt 3) / |dF|), so that F
/// changes by no more than it is, or than the unit matrix is. A step takes both rows as linear; one out of a
/// tangle that goes further ends where neither says anything of the energy.
real share_of(SolidTetrahedron t, Deformation f, rvec3 e1, rvec3 e2, rvec3 e3)
{
    real change = deformation_of(t, e1, e2, e3).square;
    real most = max(f.square, real(3));
    return SELECT(change > most, sqrt(most / max(change, most)), real(1));
}

INLINE void project(ELEMENT k)
{
    SolidTetrahedron t = constraint[k];
    rvec4 p0 = position[t.a];
    rvec4 p1 = position[t.b];
    rvec4 p2 = position[t.c];
    rvec4 p3 = position[t.d];
    rvec4 d0 = delta[t.a];
    rvec4 d1 = delta[t.b];
    rvec4 d2 = delta[t.c];
    rvec4 d3 = delta[t.d];
    Deformation f = deformation_of(t, rvec3((p1 - p0) + (d1 - d0)), rvec3((p2 - p0) + (d2 - d0)),
                                   rvec3((p3 - p0) + (d3 - d0)));
    rvec3 c0 = cross(f.f1, f.f2);
    rvec3 c1 = cross(f.f2, f.f0);
    rvec3 c2 = cross(f.f0, f.f1);
    Rows o = rows_of(t, f, c0, c1, c2);
    // r: C_D times its gradient; h: the gradient of C_H.
    rvec3 r1 = gradient_b(t, o.r0, o.r1, o.r2);
    rvec3 r2 = gradient_c(t, o.r0, o.r1, o.r2);
    rvec3 r3 = gradient_d(t, o.r0, o.r1, o.r2);
    rvec3 h1 = gradient_b(t, c0, c1, c2);
    rvec3 h2 = gradient_c(t, c0, c1, c2);
    rvec3 h3 = gradient_d(t, c0, c1, c2);
    rvec3 r0 = -((r1 + r2) + r3);
    rvec3 h0 = -((h1 + h2) + h3);
    real hh = ((p0.w * dot(h0, h0) + p1.w * dot(h1, h1)) + p2.w * dot(h2, h2)) + p3.w * dot(h3, h3);
    real rh = ((p0.w * dot(r0, h0) + p1.w * dot(r1, h1)) + p2.w * dot(r2, h2)) + p3.w * dot(r3, h3);
    real along = SELECT(hh > REAL(1e-30), rh / max(hh, REAL(1e-30)), real(0));
    r0 -= h0 * along;
    r1 -= h1 * along;
    r2 -= h2 * along;
    r3 -= h3 * along;
    real rr = ((p0.w * dot(r0, r0) + p1.w * dot(r1, r1)) + p2.w * dot(r2, r2)) + p3.w * dot(r3, r3);
    // 1/alpha of both, J h^2, bounded so that products stay finite: beyond, both constraints are rigid.
    real inverse = step_values[0].inverse_substep;
    real stiff = t.volume / (inverse * inverse);
    real grip_d = min(t.mu * stiff, REAL(1e15) / max(max(rr + along * along * hh, hh), REAL(1e-30)));
    real grip_h = min(o.lambda * stiff, REAL(1e15) / max(hh, REAL(1e-30)));
    rbool usable = o.square > REAL(1e-30); // at rest there is no shape to restore
    real pull_d = grip_d * (o.square * o.size);
    real pull_h = grip_h * o.grown;
#if LAMBDA
    real root = sqrt(SELECT(usable, o.square, real(0)));
    rvec4 before = first_iteration != 0u ? rvec4(real(0)) : multiplier[k];
    pull_d += before.x * root;
    pull_h += before.y;
#endif
    // The push is W (r u + h v): (rr + C_D^2 / grip_d + along^2 / grip_h) u - along / grip_h v =
    // (along pull_h) / grip_h - pull_d / grip_d and
    // (hh + 1 / grip_h) v - along / grip_h u = -pull_h / grip_h.
    real shape = o.square + grip_d * rr;
    real bulk = real(1) + grip_h * hh;
    real determinant = SELECT(usable, bulk * shape + (along * along) * (grip_d * hh), bulk);
    // Bracketed so: of a chain of products Mesa's OpenGL takes factors out, and the last bit differs.
    real u = ((grip_d * hh) * (along * pull_h) - bulk * pull_d) / determinant;
    u = SELECT(usable, u, real(0));
    real v = SELECT(usable, pull_h * shape + along * pull_d, pull_h) / -determinant;
    rvec3 m0 = (r0 * u + h0 * v) * p0.w;
    rvec3 m1 = (r1 * u + h1 * v) * p1.w;
    rvec3 m2 = (r2 * u + h2 * v) * p2.w;
    rvec3 m3 = (r3 * u + h3 * v) * p3.w;
    real share = share_of(t, f, m1 - m0, m2 - m0, m3 - m0);
#if LAMBDA
    multiplier[k] = before + rvec4(u * root, v - along * u, real(0), real(0)) * share;
#endif
    delta[t.a] = d0 + rvec4(m0 * share, real(0));
    delta[t.b] = d1 + rvec4(m1 * share, real(0));
    delta[t.c] = d2 + rvec4(m2 * share, real(0));
    delta[t.d] = d3 + rvec4(m3 * share, real(0));
    if (report != 0u)
        COUNT_EVENT_IF(is_collapsed(f) && ((p0.w + p1.w) + p2.w) + p3.w > real(0), events,
                       TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
