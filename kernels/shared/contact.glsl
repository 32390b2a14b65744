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

/// Tangential displacement to take away: all of `slide` inside the cone, else its limit.
rvec3 friction_removal(rvec3 slide, real limit)
{
    real size = length(slide);
    return size > limit ? slide * (limit / size) : slide;
}

#endif
