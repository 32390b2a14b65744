// The impulse of each pair in one sweep, all pairs at once. One invocation per pair.
//
//   D = max(sum_k c_k w_k b_k^2, max_k w_k |b_k| / 2), c_k the active pairs at the corner k;
//   lambda' = max(0, y - C / D),   tau' = Pi(upsilon - q / D),
//   y' = max(0, lambda' + beta (lambda' - lambda)),   upsilon' = tau' + beta (tau' - tau), 0 where y' is,
//   impulse = n (y' - y) + upsilon' - upsilon,
//
// C the gap and q the slip along the surface (contact_gap) where (y, upsilon) has put the corners, Pi the way
// into the cone |tau| <= mu lambda'. beta is 0 in the last sweep, which so leaves (lambda, tau); it is 0,
// too, for a push or a friction that has turned round, and for friction that slides.
// With c_k every vertex' mass is shared among its pairs, so a sweep without beta lowers the dual energy
// whatever the pairs are, without a factor of relaxation. The second term of D has no pair send a corner
// further than twice the violation: beside held or heavy corners a light one with a small weight b would have
// to go C / b for the nearest points to be a gap apart. Where all corners are as heavy the sum is the larger
// of both.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012; Mazhar, Heyn, Negrut, Tasora. Using Nesterov's Method to Accelerate Multibody Dynamics
//   with Friction and Contact. ACM TOG 34(3), 2015; O'Donoghue, Candes. Adaptive Restart for Accelerated
//   Gradient Schemes. Found. Comput. Math. 15, 2015; friction as shared/contact.glsl: the whole slip against
//   the whole push.
// Departures: the second term of D; beta of k / (k + 3), and a restart of each pair by itself.
// Bytes per pair: 20 + 32 + 64 + 20 a corner read, 64 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint capacity;
    uint first_sweep; // 1: multipliers start at zero
    float momentum;   // beta
};

READ(0, ContactPair, pair);
READ(1, rvec4, position); // w = inverse mass
READ(2, uint, control);
UPDATE(3, rvec4, side); // the four rows of a ContactSide
UPDATE(4, rvec4, row); // as contact_gap leaves it; after: w of the second = y, kg m
READ(5, uint, acting);
UPDATE(6, rvec4, taken); // two a pair, so far in the substep: tau, w = lambda; upsilon, w = y; kg m
WRITE(7, rvec4, impulse); // kg m

KERNEL(min(capacity, control[TAUT_CONTACT_LISTED]))
{
    ContactPair p = pair[i];
    rvec4 b = row[2u * i];
    rvec4 met = row[2u * i + 1u];
    rvec4 away = side[4u * i];
    rvec4 rubs = side[4u * i + 1u];
    rvec4 slid = side[4u * i + 2u];
    rvec3 normal = rvec3(away);
    rvec4 before = rvec4(real(0));
    rvec4 ahead = rvec4(real(0));
    if (first_sweep == 0u)
    {
        before = taken[2u * i];
        ahead = taken[2u * i + 1u];
    }
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
    real height = max(ahead.w - real(met.w) / divisor, real(0));
    rvec3 way = rvec3(met);
    rvec3 slip = way - normal * dot(normal, way);
    rvec3 tangent = rvec3(ahead) - slip / divisor;
    real limit = rubs.y * height;
    real size = length(tangent);
    tangent = SELECT(size > limit, tangent * (limit / size), tangent);
    real rise = height - before.w;
    rvec3 turn = tangent - rvec3(before);
    real along = SELECT((ahead.w - height) * rise > real(0), real(0), real(momentum));
    real across = SELECT(dot(rvec3(ahead) - tangent, turn) > real(0), real(0), real(momentum));
    across = SELECT(size > limit, real(0), across);
    real reach = max(height + rise * along, real(0));
    rvec3 nothing = rvec3(real(0)); // no push, no friction
    rvec4 next = rvec4(SELECT(reach > real(0), tangent + turn * across, nothing), reach);
    rvec3 result = normal * (next.w - ahead.w) + (rvec3(next) - rvec3(ahead));
    next = SELECT(acts, next, ahead);
    taken[2u * i] = SELECT(acts, rvec4(tangent, height), ahead); // what stays applied
    taken[2u * i + 1u] = next;
    rbool sticks = acts && height > real(0) && size <= limit;
    side[4u * i + 2u] = rvec4(rvec3(slid), SELECT(sticks, real(1), real(0)));
    row[2u * i + 1u] = rvec4(way, next.w);
    impulse[i] = SELECT(acts, rvec4(result, real(0)), rvec4(real(0)));
}
