// The impulse of each pair in one sweep, all pairs at once. One invocation per pair.
//
//   D = max(sum_k c_k w_k b_k^2, max_k w_k |b_k| / 2), c_k the active pairs at the corner k;
//   lambda' = max(0, lambda - C / D),   tau' = Pi(tau - q / D),
//   impulse = n (lambda' - lambda) + tau' - tau,
//
// q the slip along the surface since the start of the substep, Pi the way into the cone |tau| <= mu lambda'.
// With c_k every vertex' mass is shared among its pairs, so the sweep lowers the dual energy whatever
// the pairs are, without a factor of relaxation. The second term of D has no pair send a corner further than
// twice the violation: beside held or heavy corners a light one with a small weight b would have to go C / b
// for the nearest points to be a gap apart. Where all corners are as heavy the sum is the larger of both.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012; friction as shared/contact.glsl: the whole slip against the whole push of the substep.
// Departures: the second term of D.
// Bytes per pair: 20 + 32 + 48 + 20 a corner read, 32 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint capacity;
    uint first_sweep; // 1: multipliers start at zero
};

READ(0, ContactPair, pair);
READ(1, rvec4, position); // w = inverse mass
READ(2, uint, control);
READ(3, ContactSide, side);
READ(4, rvec4, row); // as contact_gap leaves it
READ(5, uint, acting);
UPDATE(6, rvec4, taken); // so far in the substep: tau, w = lambda; kg m
WRITE(7, rvec4, impulse); // kg m

KERNEL(min(capacity, control[TAUT_CONTACT_LISTED]))
{
    ContactPair p = pair[i];
    rvec4 b = row[2u * i];
    rvec4 met = row[2u * i + 1u];
    ContactSide s = side[i];
    rvec3 normal = rvec3(s.normal_x, s.normal_y, s.normal_z);
    rvec4 before = rvec4(real(0));
    if (first_sweep == 0u)
        before = taken[i];
    real b0 = b.x;
    real b1 = b.y;
    real b2 = b.z;
    real b3 = b.w;
    real w0 = position[p.a].w;
    real w1 = position[p.b].w;
    real w2 = position[p.c].w;
    real w3 = position[p.d].w;
    real first = real(acting[p.a]) * w0 * (b0 * b0);
    real second = real(acting[p.b]) * w1 * (b1 * b1);
    real third = real(acting[p.c]) * w2 * (b2 * b2);
    real fourth = real(acting[p.d]) * w3 * (b3 * b3);
    real furthest = max(max(w0 * abs(b0), w1 * abs(b1)), max(w2 * abs(b2), w3 * abs(b3)));
    real weight = max((first + second) + (third + fourth), REAL(0.5) * furthest);
    rbool acts = weight > real(0);
    real divisor = SELECT(acts, weight, real(1));
    real height_before = before.w;
    real height = max(height_before - real(met.w) / divisor, real(0));
    rvec3 way = rvec3(met);
    rvec3 slip = way - normal * dot(normal, way);
    rvec3 tangent = rvec3(before) - slip / divisor;
    real limit = s.friction * height;
    real size = length(tangent);
    tangent = SELECT(size > limit, tangent * (limit / size), tangent);
    rvec3 result = normal * (height - height_before) + (tangent - rvec3(before));
    taken[i] = SELECT(acts, rvec4(tangent, height), before);
    impulse[i] = SELECT(acts, rvec4(result, real(0)), rvec4(real(0)));
}
