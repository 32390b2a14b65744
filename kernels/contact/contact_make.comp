// What a pair of the list begins with: which side of each other its two are on, how far apart they rest, how
// they rub; and how many corners of pairs each vertex is. One invocation per pair.
//
//   normal = (x_A - x_B) / |x_A - x_B|, rest gap = r_A + r_B, of one body at most 0.9999 of the distance at
//   rest,
//   where they touch: across both; of two bodies towards up if A is of the higher, else away from it;
//   nearer than rounding tells is touching,
//   friction = (m + n) / 2, min(m, n), max(m, n), m n or sqrt(m n), m and n those of both.
//
// Based on: Mueller. Ten Minute Physics 15, 2022 (a surface thicker than its edges are long does not swell).
// Departures: the distance at rest is that of the features, not of vertices; a ten-thousandth less of it, so
//   that rounding pushes nothing that rests.
// Bytes per pair: 20 + 32 a corner read, 32 written, 4 a corner counted (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/closest.glsl"

PARAMS
{
    uint capacity;
    uint rule; // TAUT_CONTACT_MIX_*
    float blur;             // of a coordinate, relative: what is nearer than rounding touches
    float up_x, up_y, up_z; // against gravity, of length 1
};

READ(0, ContactPair, pair);
READ(1, rvec4, position);
READ(2, rvec4, rest); // m, in the shape at rest; w = body
READ(3, ContactBody, body);
READ(4, uint, control);
WRITE(5, ContactSide, side);
COUNTERS(6, corners);

INLINE Closest closest_of(uint kind, rvec3 b, rvec3 c, rvec3 d)
{
    if (kind == TAUT_CONTACT_EDGES)
        return closest_edges(b, c, d);
    return closest_vertex_triangle(b, c, d);
}

real mixed(real m, real n)
{
    if (rule == TAUT_CONTACT_MIX_MINIMUM)
        return min(m, n);
    if (rule == TAUT_CONTACT_MIX_MAXIMUM)
        return max(m, n);
    if (rule == TAUT_CONTACT_MIX_PRODUCT)
        return m * n;
    if (rule == TAUT_CONTACT_MIX_GEOMETRIC_MEAN)
        return sqrt(m * n);
    return real(0.5) * (m + n);
}

rvec3 sizes(rvec3 v)
{
    return rvec3(abs(v.x), abs(v.y), abs(v.z));
}

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        rvec3 o = rvec3(position[p.a]);
        rvec3 b = rvec3(position[p.b]) - o;
        rvec3 c = rvec3(position[p.c]) - o;
        rvec3 d = rvec3(position[p.d]) - o;
        Closest now = closest_of(p.kind, b, c, d);
        rvec3 one = p.kind == TAUT_CONTACT_EDGES ? b : c - b;
        rvec3 other = p.kind == TAUT_CONTACT_EDGES ? d - c : d - b;
        rvec3 across = cross(one, other);
        ContactBody first = body[uint(rest[p.a].w)];
        ContactBody second = body[uint(rest[p.d].w)];
        rbool same = rest[p.a].w == rest[p.d].w;
        // All pairs of two sheets that touch must agree, or they hold each other crossed.
        rvec3 up = rvec3(real(up_x), real(up_y), real(up_z));
        up = first.height < second.height ? -up : up;
        real wide = length(across);
        rbool spans = wide > REAL(1e-4) * length(one) * length(other); // else its direction is of rounding
        rvec3 normal = spans ? across / wide : up;
        normal = !same && dot(normal, up) < real(0) ? -normal : normal;
        // Places are rounded along the normal, and were turned and moved, in double, on the way here.
        rvec3 extent = sizes(o) + sizes(b) + sizes(c) + sizes(d);
        real near = real(blur) * dot(sizes(normal), extent) + REAL(4e-15) * (extent.x + extent.y + extent.z);
        if (now.squared > near * near)
            normal = now.way / sqrt(now.squared);
        real gap = first.radius + second.radius;
        if (same)
        {
            o = rvec3(rest[p.a]);
            b = rvec3(rest[p.b]) - o;
            c = rvec3(rest[p.c]) - o;
            d = rvec3(rest[p.d]) - o;
            Closest then = closest_of(p.kind, b, c, d);
            gap = min(gap, sqrt(then.squared) * REAL(0.9999));
        }
        ContactSide result;
        result.normal_x = normal.x;
        result.normal_y = normal.y;
        result.normal_z = normal.z;
        result.allowed = gap;
        result.rest_gap = gap;
        result.friction = mixed(first.friction, second.friction);
        result.unused_x = real(0);
        result.unused_y = real(0);
        result.slipped_x = real(0);
        result.slipped_y = real(0);
        result.slipped_z = real(0);
        result.sticks = real(0);
        result.weight_b = real(0);
        result.weight_c = real(0);
        result.weight_d = real(0);
        result.unused_z = real(0);
        side[i] = result;
        COUNT_EVENT(corners, p.a);
        COUNT_EVENT(corners, p.b);
        COUNT_EVENT(corners, p.c);
        COUNT_EVENT(corners, p.d);
    }
}
