// Non-penetration and Coulomb friction of one vertex against a surface of infinite mass, shared by every
// collider shape.
//
// A kernel with the line `//! each collider` is compiled once for every kernels/colliders/<stem>.glsl. The
// kernel compiler defines COLLIDER_STEM and, from the file's line `//! collider`, COLLIDER_POSES: 0 where one
// record a time step says it all ("once"), 1 where there is one of the start of each substep in turn and one
// of the end of the last ("each_substep"). A shape that says `values` behind that has COLLIDER_VALUES 1, a
// buffer `values` that it indexes as it likes, and no second form of several elements at once
// (docs/lanes.md), which only index with what records hold. The kernel includes TAUT_COLLIDER, which is that
// file. A shape that says `faces` is met by triangles, too (shared/face.glsl), in kernels with the line
// `//! each collider with faces`. Of a shape `cuboid` a kernel uses
//   cuboid_record                             the record in the buffer of colliders
//   cuboid_contact(record, next, x, d, kept)  what the vertex at x meets that goes by d; of a shape "once",
//   plane_contact(record, substep, substeps, x, d, kept)
//   cuboid_slide(contact, d)                  what is left of the way along the surface, once pushed out, m
//   cuboid_way(contact, d)                    the vertex' way as seen from the surface, m
// under the names OF_COLLIDER(record) and so on.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 6.1, with
//   the accumulated normal push of the substep as the cone's height, so that the result does not depend
//   on the iteration count.
// Departures: the way out of a penetration that was there before the substep is limited to
//   `depenetration` a substep, and to h sqrt(g depth): as a floor that rises by that depth and is braked by
//   g / 2, so that what lies on it does not leave it.
//   Triangles (shared/face.glsl) have the first bound alone.
#ifndef TAUT_SHARED_CONTACT_GLSL
#define TAUT_SHARED_CONTACT_GLSL

#define COLLIDER_JOIN_WORDS(stem, name) stem##_##name
#define COLLIDER_JOIN(stem, name) COLLIDER_JOIN_WORDS(stem, name)
#define OF_COLLIDER(name) COLLIDER_JOIN(COLLIDER_STEM, name)

/// What a shape says of one vertex during one substep. Heights are above the surface moved out by the gap
/// kept; both are 0 where the vertex does not come near the surface that they are of.
struct Contact
{
    rvec3 normal;  // away from the collider, where the vertex meets it
    real before;   // height at the start of the substep, m
    real gap;      // height at the end, before the push, m
    rvec3 motion;  // m, of the surface there; of a shape that turns, of the vertex as seen from it
    real friction; // Coulomb coefficient, >= 0
};

/// The part of `v` along a surface.
INLINE rvec3 along_surface(rvec3 normal, rvec3 v)
{
    return v - normal * dot(normal, v);
}

/// How far a substep lets out what began it below the surface, m.
real way_out(real gap_before, real depenetration, real braked)
{
    return min(depenetration, braked * sqrt(max(-gap_before, real(0))));
}

/// Where the gap may end: 0, or less deep than it began when it began below the surface.
real allowed_gap(real gap_before, real way)
{
    return min(real(0), gap_before + way);
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
