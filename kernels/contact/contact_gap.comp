// How far apart the two of a pair are, where each stands at present. One invocation per pair.
//
//   gap = n . sum b_k (x_k + d_k), n from the second to the first,   C = gap - allowed;
//
// a pair with C < 0 is active, and counts at each corner that its weights b touch. The side is kept: where
// the way between the two turns round while the nearest points lie within, they have passed through each
// other, and the gap is negative. At the first sweep of a substep the allowed gap is set:
//
//   allowed = min(rest gap, gap at the start of the substep + depenetration).
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 4.4.
// Departures: nearest points and normal are found anew in every sweep; the gap at the start is taken along
//   the normal of the first sweep, with its weights. Edges only count while neither end is nearest: there a
//   vertex and a triangle are as near.
// Bytes per pair: 20 + 24 + 32 a corner read, 24 + 32 written (float).
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
UPDATE(5, ContactSide, side);
WRITE(6, rvec4, row); // two a pair: the weights of its corners, 0 if it is not active; slip m, w = C m
COUNTERS(7, acting); // pairs at each vertex

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        rvec4 x0 = position[p.a];
        rvec4 x1 = position[p.b];
        rvec4 x2 = position[p.c];
        rvec4 x3 = position[p.d];
        rvec4 d0 = delta[p.a];
        rvec4 d1 = delta[p.b];
        rvec4 d2 = delta[p.c];
        rvec4 d3 = delta[p.d];
        rvec3 e1 = rvec3((x1 - x0) + (d1 - d0));
        rvec3 e2 = rvec3((x2 - x0) + (d2 - d0));
        rvec3 e3 = rvec3((x3 - x0) + (d3 - d0));
        Closest now = closest_vertex_triangle(e1, e2, e3);
        if (p.kind == TAUT_CONTACT_EDGES)
            now = closest_edges(e1, e2, e3);
        ContactSide s = side[i];
        rvec3 normal = rvec3(s.normal_x, s.normal_y, s.normal_z);
        real size = sqrt(now.squared);
        bool through = now.inside && dot(now.way, normal) < real(0);
        if (size > real(0))
            normal = now.way / (through ? -size : size);
        real gap = through ? -size : size;
        rvec4 b = now.weight;
        rvec3 slip = (rvec3(d1 - d0) * b.y + rvec3(d2 - d0) * b.z) + rvec3(d3 - d0) * b.w;
        real before = gap - dot(normal, slip);
        if (first_sweep != 0u)
            s.allowed = min(s.rest_gap, before + step_values[0].depenetration);
        real value = gap - s.allowed;
        real masses = (x0.w * b.x * b.x + x1.w * b.y * b.y) + (x2.w * b.z * b.z + x3.w * b.w * b.w);
        bool acts = value < real(0) && masses > real(0) && (p.kind == TAUT_CONTACT_VERTEX || now.inside);
        b = acts ? b : rvec4(real(0));
        s.normal_x = normal.x;
        s.normal_y = normal.y;
        s.normal_z = normal.z;
        side[i] = s;
        row[2u * i] = b;
        row[2u * i + 1u] = rvec4(slip, value);
        COUNT_EVENT_IF(b.x != real(0), acting, p.a);
        COUNT_EVENT_IF(b.y != real(0), acting, p.b);
        COUNT_EVENT_IF(b.z != real(0), acting, p.c);
        COUNT_EVENT_IF(b.w != real(0), acting, p.d);
    }
}
