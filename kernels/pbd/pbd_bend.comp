// PBD dihedral bending. Coloured: one invocation per hinge of one colour (no two share a vertex).
// Variant `slots`: one invocation per hinge of all, which writes what it wants for pbd_average.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006, section 4.4.
// Departures: see shared/pbd.glsl and shared/hinge.glsl.
// Bytes per element: 24 constraint + 128 read + 64 written (float).
//! lanes
//! variant tail TAIL=1
//! variant slots SLOTS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"

PARAMS
{
    uint first;  // first hinge of the colour; in the tail variant the table's first range
    uint count;  // hinges of the colour; groups in the tail variant
    float share; // of a correction that one iteration makes
    uint report; // 1: count degenerate hinges
};

READ(0, BendingConstraint, constraint); // its compliance is not read
READ(1, rvec4, position);               // xyz m, w = inverse mass 1/kg
COUNTERS(3, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(4, uint, table);          // as in pbd_stretch
#elif SLOTS
READ(2, rvec4, delta);
WRITE(4, rvec4, correction); // displacement per inverse mass, kg m: correction[4 * hinge + corner]
#else
UPDATE(2, rvec4, delta);
#endif

void project(ELEMENT k)
{
    BendingConstraint c = constraint[k];
    rvec4 p0 = position[c.edge0];
    rvec4 p1 = position[c.edge1];
    rvec4 p2 = position[c.wing0];
    rvec4 p3 = position[c.wing1];
    rvec4 d0 = delta[c.edge0];
    rvec4 d1 = delta[c.edge1];
    rvec4 d2 = delta[c.wing0];
    rvec4 d3 = delta[c.wing1];
    HingePush wanted = hinge_push(c, p0, p1, p2, p3, d0, d1, d2, d3, real(share));
#if SLOTS
    correction[4u * k] = rvec4(wanted.edge0, real(0));
    correction[4u * k + 1u] = rvec4(wanted.edge1, real(0));
    correction[4u * k + 2u] = rvec4(wanted.wing0, real(0));
    correction[4u * k + 3u] = rvec4(wanted.wing1, real(0));
#else
    delta[c.edge0] = d0 + rvec4(wanted.edge0 * p0.w, real(0));
    delta[c.edge1] = d1 + rvec4(wanted.edge1 * p1.w, real(0));
    delta[c.wing0] = d2 + rvec4(wanted.wing0 * p2.w, real(0));
    delta[c.wing1] = d3 + rvec4(wanted.wing1 * p3.w, real(0));
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!wanted.shaped && p0.w + p1.w + p2.w + p3.w > real(0), events,
                       TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
