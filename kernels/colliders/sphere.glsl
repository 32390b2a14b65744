// Ball, swept over the substep so that vertices do not tunnel.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.3.2 (a segment against a ball).
// Departures: a vertex at rest on the surface lies a rounding inside as often as outside; both came from
//   there.
//
// In the frame of the ball the vertex moves on the segment from `a` to `e`. If `e` lies inside on the side
// where the vertex came from, the nearest surface point decides; if the segment enters and ends on the
// other side or outside again, the point of entry does.
//! collider once faces

#define sphere_record SphereCollider

INLINE Contact sphere_contact(SphereCollider c, real substep, real substeps, rvec3 x, rvec3 d, real gap_kept)
{
    Contact met;
    rvec3 from = rvec3(c.start_x, c.start_y, c.start_z);
    rvec3 shift = (rvec3(c.end_x, c.end_y, c.end_z) - from) / substeps;
    real r = c.radius + gap_kept;
    rvec3 a = x - (from + shift * substep);
    rvec3 travel = d - shift;
    rvec3 e = a + travel;
    real outside = dot(a, a) - r * r;
    real along = dot(a, travel);
    real square = dot(travel, travel);
    real discriminant = along * along - square * outside;
    real root = sqrt(max(discriminant, real(0)));
    real entry = SELECT(square > real(0), max((-along - root) / square, real(0)), real(2));
    rbool came_from_outside = outside >= REAL(-1e-3) * r * r && along < real(0);
    rbool enters = came_from_outside && discriminant > real(0) && entry <= real(1);
    rbool far_side = enters && (dot(a, e) <= real(0) || dot(e, e) >= r * r);
    rvec3 towards = SELECT(far_side, a + travel * entry, e);
    real size = length(towards);
    // A vertex exactly at the centre leaves upwards: any direction is as good.
    met.normal = SELECT(size > real(0), towards / size, rvec3(real(0), real(1), real(0)));
    met.before = sqrt(dot(a, a)) - r;
    met.gap = dot(met.normal, e) - r;
    met.motion = shift;
    met.friction = c.friction;
    return met;
}

INLINE rvec3 sphere_slide(Contact met, rvec3 d)
{
    return along_surface(met.normal, d - met.motion);
}

INLINE rvec3 sphere_way(Contact met, rvec3 d) { return d - met.motion; }

#if COLLIDER_MEETS_FACES
#include "shared/face.glsl"

INLINE real sphere_reach(SphereCollider c, real gap_kept) { return c.radius + gap_kept; }

INLINE bool sphere_contains(SphereCollider c, real gap_kept, rvec3 x)
{
    real r = c.radius + gap_kept;
    return dot(x, x) < r * r;
}

INLINE bool sphere_apart(SphereCollider c, Face f) { return false; } // it may have gone through

INLINE Face sphere_face(SphereCollider c, Face f)
{
    return press_ball(f, rvec3(real(0)), c.radius + f.gap_kept);
}
#endif
