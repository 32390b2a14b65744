// The impulse of each pair in one sweep, all pairs at once. One invocation per pair.
//
//   D = sum_k c_k w_k b_k^2, c_k the active pairs at the corner k;
//   lambda' = max(0, lambda - C / D),   tau' = Pi(tau - q / D),
//   impulse = n (lambda' - lambda) + tau' - tau,
//
// q the slip along the surface since the start of the substep, Pi the way into the cone |tau| <= mu lambda'.
// With c_k every vertex' mass is shared among its pairs, so the sweep lowers the dual energy whatever
// the pairs are, without a factor of relaxation.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012; friction as shared/contact.glsl: the whole slip against the whole push of the substep.
// Departures: none.
// Bytes per pair: 20 + 24 + 48 + 20 a corner read, 32 written (float).
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

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        rvec4 b = row[2u * i];
        rvec4 met = row[2u * i + 1u];
        ContactSide s = side[i];
        rvec3 normal = rvec3(s.normal_x, s.normal_y, s.normal_z);
        rvec4 before = first_sweep != 0u ? rvec4(real(0)) : taken[i];
        real first = real(acting[p.a]) * position[p.a].w * (b.x * b.x);
        real second = real(acting[p.b]) * position[p.b].w * (b.y * b.y);
        real third = real(acting[p.c]) * position[p.c].w * (b.z * b.z);
        real fourth = real(acting[p.d]) * position[p.d].w * (b.w * b.w);
        real weight = (first + second) + (third + fourth);
        rvec4 now = before;
        rvec3 result = rvec3(real(0));
        if (weight > real(0))
        {
            real height = max(before.w - met.w / weight, real(0));
            rvec3 slip = rvec3(met) - normal * dot(normal, rvec3(met));
            rvec3 tangent = rvec3(before) - slip / weight;
            real limit = s.friction * height;
            real size = length(tangent);
            tangent = size > limit ? tangent * (limit / size) : tangent;
            result = normal * (height - before.w) + (tangent - rvec3(before));
            now = rvec4(tangent, height);
        }
        taken[i] = now;
        impulse[i] = rvec4(result, real(0));
    }
}
