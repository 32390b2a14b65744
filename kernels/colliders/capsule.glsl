// Capsule, swept over the substep so that vertices do not tunnel.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.7 (a segment against a capsule: its ends as
//   balls, its side as a cylinder).
// Departures: a vertex at rest on the surface lies a rounding inside as often as outside; both came from
//   there.
//
// In the frame of the capsule, which may move and turn, the vertex goes from `a` to `e`, taken as a straight
// way. If `e` lies inside on the side where the vertex came from, the nearest surface point decides; if the
// way enters and ends on the other side or outside again, the point of entry does.
//! collider each_substep faces
#include "shared/turned.glsl"

#define capsule_record CapsuleCollider
#define capsule_slide slide_of_turned
#define capsule_way way_of_turned

/// From the nearest point of the axis to p.
INLINE rvec3 off_axis(rvec3 p, real half_length)
{
    return rvec3(p.x, p.y - min(max(p.y, -half_length), half_length), p.z);
}

/// When a point comes to where `outside` is 0; its square distance there, its approach and its speed squared
/// are those of time 0. 0 when it is there already, 2 = never.
INLINE real time_in(real outside, real along, real square)
{
    real discriminant = along * along - square * outside;
    real root = sqrt(max(discriminant, real(0)));
    rbool enters = discriminant > real(0) && along < real(0) && square > real(0);
    return SELECT(enters, max((-along - root) / square, real(0)), real(2));
}

/// The same for a ball of the square radius about 0.
INLINE real time_into_ball(rvec3 a, rvec3 travel, real square_radius)
{
    return time_in(dot(a, a) - square_radius, dot(a, travel), dot(travel, travel));
}

INLINE Contact capsule_contact(CapsuleCollider c, CapsuleCollider next, rvec3 x, rvec3 d, real gap_kept)
{
    Contact met;
    rvec3 here = x - CENTRE_OF(c), there = (x - CENTRE_OF(next)) + d;
    rvec3 a = INTO_FRAME(c, here);
    rvec3 e = INTO_FRAME(next, there);
    rvec3 travel = e - a;
    real r = c.radius + gap_kept;
    real rr = r * r;
    rvec3 qa = off_axis(a, c.half_length), qe = off_axis(e, c.half_length);
    rbool came_from_outside = dot(qa, qa) - rr >= REAL(-1e-3) * rr && dot(qa, travel) < real(0);
    real side = time_in((a.x * a.x + a.z * a.z) - rr, a.x * travel.x + a.z * travel.z,
                        travel.x * travel.x + travel.z * travel.z);
    side = SELECT(abs(a.y + travel.y * side) <= c.half_length, side, real(2));
    rvec3 up = rvec3(real(0), c.half_length, real(0));
    real entry = min(side, min(time_into_ball(a - up, travel, rr), time_into_ball(a + up, travel, rr)));
    rbool enters = came_from_outside && entry <= real(1);
    rbool far_side = enters && (dot(qa, qe) <= real(0) || dot(qe, qe) >= rr);
    rvec3 meets = SELECT(far_side, a + travel * entry, e);
    rvec3 towards = off_axis(meets, c.half_length);
    real size = length(towards);
    // A vertex exactly on the axis leaves across it: any such direction is as good.
    rvec3 own = SELECT(size > real(0), towards / size, rvec3(real(1), real(0), real(0)));
    met.normal = OUT_OF_FRAME(next, own);
    met.before = sqrt(dot(qa, qa)) - r;
    met.gap = dot(own, e - (meets - towards)) - r;
    met.motion = OUT_OF_FRAME(next, travel);
    met.friction = c.friction;
    return met;
}

#if COLLIDER_MEETS_FACES
#include "shared/face.glsl"

INLINE real capsule_reach(CapsuleCollider c, real gap_kept)
{
    return (c.half_length + c.radius) + gap_kept;
}

INLINE bool capsule_contains(CapsuleCollider c, real gap_kept, rvec3 x)
{
    rvec3 off = off_axis(x, c.half_length);
    real r = c.radius + gap_kept;
    return dot(off, off) < r * r;
}

INLINE bool capsule_apart(CapsuleCollider c, Face f) { return false; } // it may have gone through

/// Across both, of length 1; 0 where they are parallel to 1e-3: what is across is rounding then, and they are
/// nearest at an end, too.
INLINE rvec3 across_or_zero(rvec3 u, rvec3 v)
{
    rvec3 across = cross(u, v);
    real size = length(across);
    return size > REAL(1e-3) * (length(u) * length(v)) ? across / size : rvec3(real(0));
}

/// The axis, of radius `r`, against the edge from the corner of the weights `first` to that of `second`; its
/// ends are balls, and met on their own. If the axis went through the edge during the substep, the point
/// where it did goes back.
INLINE Face press_axis(Face f, real half_length, real r, rvec3 first, rvec3 second)
{
    rvec3 up = rvec3(real(0), half_length, real(0));
    rvec3 pa = place_at_start(f, first), pb = place_at_start(f, second);
    rvec3 ea = place_at_end(f, first), eb = place_at_end(f, second);
    Closest near = closest_edges(up * real(2), ea + up, eb + up);
    rvec3 across_before = across_or_zero(up, pb - pa);
    rvec3 across_after = across_or_zero(up, eb - ea);
    real before = dot(across_before, pa), after = dot(across_after, ea);
    rvec3 normal = unit_or_zero(SELECT(near.squared > real(0), -near.way, across_before));
    bool meets = near.inside && dot(across_after, across_after) > real(0);
    rvec3 b = first * -near.weight_c + second * -near.weight_d;
    if (before * after < real(0))
    {
        real t = before / (before - after);
        Closest met = closest_edges(up * real(2), (pa + up) + (ea - pa) * t, (pb + up) + (eb - pb) * t);
        if (met.inside)
        {
            meets = true;
            b = first * -met.weight_c + second * -met.weight_d;
            normal = SELECT(before < real(0), -across_after, across_after);
        }
    }
    real height = dot(normal, place_at_end(f, b)) - r;
    if (meets && height < real(0))
    {
        rvec3 off = off_axis(place_at_start(f, b), half_length);
        f = press(f, normal, length(off) - r, height, b);
    }
    return f;
}

INLINE Face capsule_face(CapsuleCollider c, Face f)
{
    real r = c.radius + f.gap_kept;
    rvec3 up = rvec3(real(0), c.half_length, real(0));
    rvec3 x = rvec3(real(1), real(0), real(0)), y = rvec3(real(0), real(1), real(0));
    rvec3 z = rvec3(real(0), real(0), real(1));
    f = press_axis(f, c.half_length, r, x, y);
    f = press_axis(f, c.half_length, r, y, z);
    f = press_axis(f, c.half_length, r, z, x);
    f = press_ball(f, up, r);
    return press_ball(f, -up, r);
}
#endif
