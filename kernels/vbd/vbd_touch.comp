// Which surface is in a vertex' way in a substep of vertex block descent, of the colliders of one shape and
// of those before: the plane that the inertial guess goes deepest behind, for the sweeps
// (shared/vbd_contact.glsl). One invocation per vertex; loops over the colliders.
//
// Based on: shared/contact.glsl, and the shape's own file for what a vertex meets.
// Departures: a surface that the guess stays outside of is asked for moved out by twice its way as seen from
//   the surface, so that sweeps do not push into it what the guess leaves there; one plane a vertex: what is
//   behind others is for the contacts after the sweeps, and all of what has held vertices.
// Bytes per element: 36 read, 64 written; of a second shape 48 more read (float).
//! each collider
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact.glsl"
#include "shared/vbd_parts.h"
#if COLLIDER_VALUES
READ(7, real, values); // of all colliders of the shape, one after the other
#endif
#include TAUT_COLLIDER

PARAMS
{
    uint count;
    uint colliders;
    uint substep;
    uint substeps;
    uint first;    // 1: no other shape came before
    uint surfaces; // where in `contacts` they begin, four reals each
    uint guesses;  // 1: before them stand the guesses
};

READ(0, rvec4, position); // w = inverse mass, 1/kg
READ(1, rvec4, delta);    // the inertial guess, m; w = gap kept from colliders
READ(2, OF_COLLIDER(record), collider);
READ_ONE(3, StepValues, step_values);
UPDATE(4, rvec4, contacts); // per vertex the guess and its inertia, m / h^2; at `surfaces` what
                            // shared/vbd_parts.h says: in place of the push how near the plane is, m
READ(5, uint, support);     // 2 * body + (1: it has held vertices)
COUNTERS(6, touched);       // by body

Contact met_at(uint j, rvec3 x, rvec3 d, real gap_kept)
{
#if COLLIDER_POSES
    OF_COLLIDER(record) c = collider[substep * colliders + j];
    return OF_COLLIDER(contact)(c, collider[(substep + 1u) * colliders + j], x, d, gap_kept);
#else
    return OF_COLLIDER(contact)(collider[j], real(substep), real(substeps), x, d, gap_kept);
#endif
}

KERNEL(count)
{
    rvec4 p = position[i];
    rvec4 guess = delta[i];
    rvec3 x = rvec3(p), d = rvec3(guess);
    bool moves = p.w > real(0);
    bool sweeps = support[i] % 2u == 0u; // of a body with something held contacts come after the sweeps
    uint at = surfaces + TAUT_VBD_CONTACT * i;
    rvec4 plane = rvec4(real(0));
    rvec4 drag = rvec4(real(0));
    real nearest = REAL(1e30);
    bool meets = false;
    if (first == 0u)
    {
        plane = contacts[at + TAUT_VBD_PLANE];
        drag = contacts[at + TAUT_VBD_DRAG];
        nearest = contacts[at + TAUT_VBD_REACTION].x;
    }
    for (uint j = 0u; j < colliders; ++j)
    {
        // Moved out by as much as the guess goes, a ball holds every place that it comes from: on which side
        // it came in only the surface itself says.
        Contact met = met_at(j, x, d, guess.w);
        bool hit = met.gap < real(0);
        real margin = hit ? real(0) : real(2) * length(OF_COLLIDER(way)(met, d));
        if (!hit)
            met = met_at(j, x, d, guess.w + margin);
        // What goes away is in nobody's way.
        bool near = hit || (met.gap < real(0) && met.gap < met.before);
        // From below a surface a vertex need only go no deeper: contacts after the sweeps let it out.
        real height = (met.gap + margin) - min(real(0), met.before + margin);
        meets = meets || hit;
        if (sweeps && near && height < nearest)
        {
            rvec3 n = met.normal;
            nearest = height;
            plane = rvec4(n, dot(n, d) - height);
            drag = rvec4(d - OF_COLLIDER(way)(met, d), met.friction);
        }
    }
    if (first != 0u && guesses != 0u)
    {
        real per_substep = step_values[0].inverse_substep;
        contacts[i] = rvec4(d, moves ? (per_substep * per_substep) / p.w : real(0));
    }
    contacts[at + TAUT_VBD_PLANE] = plane;
    contacts[at + TAUT_VBD_DRAG] = drag;
    contacts[at + TAUT_VBD_REACTION] = rvec4(nearest, real(0), real(0), real(0));
    if (meets && moves)
        COUNT_EVENT(touched, support[i] / 2u);
}
