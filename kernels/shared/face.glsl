// A triangle against a collider of infinite mass, in the collider's own frame: what collide/face.comp hands
// to a shape, and how a point of the triangle is pushed out.
//
// A shape with the word `faces` in its line `//! collider` (shared/contact.glsl) has, of a shape `cuboid`,
//   cuboid_reach(record, gap kept)         how far its surface is from the origin of its frame at most, m
//   cuboid_contains(record, gap kept, x)   whether a point of the frame is in it
//   cuboid_apart(record, face)             whether nothing of the triangle is in its way where ways end
//   cuboid_face(record, face)              pushes the points of the triangle that are in its way
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 6.1 (a contact
//   as a constraint of positions), for the point sum_k b_k x_k with b_0 + b_1 + b_2 = 1.
// Departures: the divisor is never less than half of the largest w_k b_k, as in contact/contact_push.comp: a
//   light corner beside held ones is not thrown. Since face_move takes means, a point may be left below the
//   surface; it may come back by as much as it went in, too, however slow `depenetration` is.
#ifndef TAUT_SHARED_FACE_GLSL
#define TAUT_SHARED_FACE_GLSL

#include "shared/closest.glsl"

/// In the frame of the collider, m. Corners go straight during the substep.
struct Face
{
    rvec3 p0, p1, p2;    // at the start of the substep
    rvec3 e0, e1, e2;    // at its end
    real w0, w1, w2;     // inverse masses, 1/kg
    rvec3 share;         // of pushes so far at each corner: the sum of their b
    rvec4 taken;         // in the substep so far: impulses of friction, w = the sum of mu times pushes, kg m
    real gap_kept;       // m
    real depenetration;  // m a substep
    real friction;       // Coulomb coefficient
};

/// Pushes the point b from the height `gap` above the surface out along `normal`, and holds it back by
/// friction:
///
///   push = min(0, before + max(depenetration, before - gap)) - gap,  p = push / W,
///   e_k += (n p - f) w_k b_k,  W = max(sum_k w_k b_k^2, max_k w_k b_k / 2),  |sum f| <= sum mu p.
INLINE Face press(Face f, rvec3 normal, real before, real gap, rvec3 b)
{
    real back = max(f.depenetration, before - gap);
    real push = max(allowed_gap(before, back) - gap, real(0));
    rvec3 wb = rvec3(f.w0 * b.x, f.w1 * b.y, f.w2 * b.z);
    real weight = max(dot(wb, b), real(0.5) * max(wb.x, max(wb.y, wb.z)));
    if (push > real(0) && weight > real(0))
    {
        rvec3 travel = ((f.e0 - f.p0) * b.x + (f.e1 - f.p1) * b.y) + (f.e2 - f.p2) * b.z;
        real impulse = push / weight;
        rvec4 held = friction_taken(f.taken, along_surface(normal, travel) / weight, f.friction * impulse,
                                    real(1));
        rvec3 way = normal * impulse - rvec3(held - f.taken);
        f.taken = held;
        f.e0 += way * wb.x;
        f.e1 += way * wb.y;
        f.e2 += way * wb.z;
        f.share += b;
    }
    return f;
}

/// Weights of the point of a triangle of a pair as shared/closest.glsl has them for a vertex and a triangle.
INLINE rvec3 weights_of(Closest c) { return rvec3(-c.weight_b, -c.weight_c, -c.weight_d); }

INLINE rvec3 place_at_start(Face f, rvec3 b) { return (f.p0 * b.x + f.p1 * b.y) + f.p2 * b.z; }
INLINE rvec3 place_at_end(Face f, rvec3 b) { return (f.e0 * b.x + f.e1 * b.y) + f.e2 * b.z; }

/// A vector of length 1, or 0 where it has none.
INLINE rvec3 unit_or_zero(rvec3 v)
{
    real size = length(v);
    return size > real(0) ? v / size : rvec3(real(0));
}

/// Against a ball of radius `r` about `o`. The point nearest to o is pushed away from it; if o went through
/// the triangle during the substep, the point where it did goes back to the side where it came from.
INLINE Face press_ball(Face f, rvec3 o, real r)
{
    Closest near = closest_vertex_triangle(f.e0 - o, f.e1 - o, f.e2 - o);
    rvec3 normal_before = unit_or_zero(cross(f.p1 - f.p0, f.p2 - f.p0));
    rvec3 normal_after = unit_or_zero(cross(f.e1 - f.e0, f.e2 - f.e0));
    real before = dot(normal_before, f.p0 - o);
    real after = dot(normal_after, f.e0 - o);
    rvec3 out_of = SELECT(near.squared > real(0), -near.way, normal_before);
    rvec3 normal = unit_or_zero(out_of);
    rvec3 b = weights_of(near);
    if (before * after < real(0))
    {
        real t = before / (before - after);
        Closest met = closest_vertex_triangle((f.p0 - o) + (f.e0 - f.p0) * t, (f.p1 - o) + (f.e1 - f.p1) * t,
                                              (f.p2 - o) + (f.e2 - f.p2) * t);
        if (met.inside)
        {
            b = weights_of(met);
            normal = SELECT(before < real(0), -normal_after, normal_after);
        }
    }
    real height = dot(normal, place_at_end(f, b) - o) - r;
    if (height < real(0))
        f = press(f, normal, length(place_at_start(f, b) - o) - r, height, b);
    return f;
}

#endif
