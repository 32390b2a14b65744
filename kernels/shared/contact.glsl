// Non-penetration and Coulomb friction of one vertex against a surface of infinite mass, shared by every
// collider shape.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 6.1, with
//   the accumulated normal push of the substep as the cone's height, so that the result does not depend
//   on the iteration count.
// Departures: the way out of a penetration that was there before the substep is limited to
//   `depenetration` a substep, so that it never becomes exit speed.
#ifndef TAUT_SHARED_CONTACT_GLSL
#define TAUT_SHARED_CONTACT_GLSL

/// Where the gap may end: 0, or less deep than it began when it began below the surface.
real allowed_gap(real gap_before, real depenetration)
{
    return min(real(0), gap_before + depenetration);
}

/// Friction taken so far in the substep (xyz) and the normal push so far (w), brought up to date: all of the
/// slide inside the cone, else its limit. `slide` is what is left of the tangential displacement.
rvec4 friction_taken(rvec4 taken, rvec3 slide, real push, real friction)
{
    real height = taken.w + push;
    real limit = friction * height;
    rvec3 whole = slide + rvec3(taken);
    real size = length(whole);
    return rvec4(SELECT(size > limit, whole * (limit / size), whole), height);
}

#endif
