// How far apart the two of a pair are, where each stands at present. One invocation per pair.
//
//   gap = n . sum b_k (x_k + d_k), n from the second to the first,   C = gap - allowed;
//
// a pair with C < 0, or one that pushes already, is active, and counts at each corner that its weights b
// touch. The side is kept: where the way between the two turns round while the nearest points lie within,
// they have passed through each other, and the gap is negative. At the first sweep of a substep the allowed
// gap is set:
//
//   allowed = min(rest gap, gap at the start of the substep + depenetration).
//
// What slips is what it has slipped in this substep, and what friction had yet to take back of a pair that
// stuck at the end of the last one:
//
//   slip = q + sum b_k d_k,   q = carried + sum b_k (x_k - y_k) of the last sweep before, along the surface,
//
// no longer than depenetration / 64 (what an impact leaves is not slip of something that lies),
// y where its corners were when that substep began. Kept is carried - sum b_k x_k, so nobody needs to know y.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 4.4.
// Departures: nearest points and normal are found anew in every sweep; the gap at the start is taken along
//   the normal of the first sweep, with its weights. Edges only count while neither end is nearest: there a
//   vertex and a triangle are as near.
// Bytes per pair: 20 + 32 + 32 a corner read, 16 + 32 written, 16 read anew (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/closest.glsl"

PARAMS
{
    uint capacity;
    uint first_sweep; // of the substep
};

READ(0, ContactPair, pair);
READ(1, rvec4, position); // w = inverse mass
READ(2, rvec4, delta);    // m, since the start of the substep
READ_ONE(3, StepValues, step_values);
READ(4, uint, control);
UPDATE(5, rvec4, side); // the four rows of a ContactSide
// Two a pair: the weights of its corners, 0 if it is not active; slip m, w = C m. Before: w = y, as
// contact_push left it.
UPDATE(6, rvec4, row);
COUNTERS(7, acting); // pairs at each vertex

KERNEL(min(capacity, control[TAUT_CONTACT_LISTED]))
{
    ContactPair p = pair[i];
    rvec4 x0 = position[p.a];
    rvec4 x1 = position[p.b];
    rvec4 x2 = position[p.c];
    rvec4 x3 = position[p.d];
    rvec4 d0 = delta[p.a];
    rvec3 d1 = rvec3(delta[p.b] - d0);
    rvec3 d2 = rvec3(delta[p.c] - d0);
    rvec3 d3 = rvec3(delta[p.d] - d0);
    rbool edges = p.kind == TAUT_CONTACT_EDGES;
    Closest now = closest_of_pair(edges, rvec3(x1 - x0) + d1, rvec3(x2 - x0) + d2, rvec3(x3 - x0) + d3);
    rvec4 kept = side[4u * i];
    rvec3 normal = rvec3(kept);
    real size = sqrt(now.squared);
    rbool through = now.inside && dot(now.way, normal) < real(0);
    real gap = SELECT(through, -size, size);
    normal = SELECT(size > real(0), now.way / gap, normal);
    rvec3 moved = (d1 * now.weight_b + d2 * now.weight_c) + d3 * now.weight_d;
    real allowed = kept.w;
    rvec3 e1 = rvec3(x1 - x0);
    rvec3 e2 = rvec3(x2 - x0);
    rvec3 e3 = rvec3(x3 - x0);
    rvec4 slid = side[4u * i + 2u];
    rvec4 was = side[4u * i + 3u];
    rvec3 carried = rvec3(slid) + ((e1 * was.x + e2 * was.y) + e3 * was.z);
    if (first_sweep != 0u)
    {
        rvec4 rest = side[4u * i + 1u];
        allowed = min(real(rest.x), (gap - dot(normal, moved)) + step_values[0].depenetration);
        rvec3 along = carried - normal * dot(normal, carried);
        real most = real(step_values[0].depenetration) * REAL(0.015625);
        real length = sqrt(dot(along, along));
        along = SELECT(length > most, along * (most / length), along);
        carried = SELECT(slid.w > real(0), along, rvec3(real(0)));
    }
    real value = gap - allowed;
    rvec4 left = row[2u * i + 1u];
    real ahead = left.w;
    if (first_sweep != 0u)
        ahead = real(0);
    real m0 = x0.w * now.weight_a * now.weight_a;
    real m1 = x1.w * now.weight_b * now.weight_b;
    real m2 = x2.w * now.weight_c * now.weight_c;
    real m3 = x3.w * now.weight_d * now.weight_d;
    rbool wanted = value < real(0) || ahead > real(0);
    rbool acts = wanted && (m0 + m1) + (m2 + m3) > real(0) && (!edges || now.inside);
    real wa = SELECT(acts, now.weight_a, real(0));
    real wb = SELECT(acts, now.weight_b, real(0));
    real wc = SELECT(acts, now.weight_c, real(0));
    real wd = SELECT(acts, now.weight_d, real(0));
    rvec3 here = (e1 * now.weight_b + e2 * now.weight_c) + e3 * now.weight_d;
    side[4u * i] = rvec4(normal, allowed);
    side[4u * i + 2u] = rvec4(carried - here, slid.w);
    side[4u * i + 3u] = rvec4(now.weight_b, now.weight_c, now.weight_d, real(0));
    row[2u * i] = rvec4(wa, wb, wc, wd);
    row[2u * i + 1u] = rvec4(carried + moved, value);
    COUNT_EVENT_IF(wa != real(0), acting, p.a);
    COUNT_EVENT_IF(wb != real(0), acting, p.b);
    COUNT_EVENT_IF(wc != real(0), acting, p.c);
    COUNT_EVENT_IF(wd != real(0), acting, p.d);
}
