// PBD distance constraint. Coloured: one invocation per constraint of one colour (no two share a vertex).
// Variant `slots`: one invocation per constraint of all, which writes what it wants for pbd_average.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006, section 4.1.
//   Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics. 2015: colours.
// Departures: see shared/pbd.glsl; works on displacements of the substep (`delta`).
// Bytes per element: 16 constraint + 64 read + 32 written (float); slots: 16 written.
//! lanes
//! variant tail TAIL=1
//! variant slots SLOTS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"

PARAMS
{
    uint first;  // first constraint of the colour; in the tail variant the table's first range
    uint count;  // constraints of the colour; groups in the tail variant
    float share; // of a correction that one iteration makes
    uint report; // 1: count degenerate constraints
};

READ(0, DistanceConstraint, constraint); // its compliance is not read
READ(1, rvec4, position);                // xyz m, w = inverse mass 1/kg
COUNTERS(3, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(4, uint, table);          // two words a group, {begin, end}: table[c] for c = begin..end are the
                               // first constraints of its colours, and the end of the last
#elif SLOTS
READ(2, rvec4, delta);
WRITE(4, rvec4, correction); // displacement of end a per inverse mass, kg m; that of b is its negative
#else
UPDATE(2, rvec4, delta);
#endif

void project(ELEMENT k)
{
    DistanceConstraint c = constraint[k];
    rvec4 xa = position[c.a];
    rvec4 xb = position[c.b];
    rvec4 da = delta[c.a];
    rvec4 db = delta[c.b];
    SpringPush wanted = spring_push(c, xa, xb, da, db, real(share));
#if SLOTS
    correction[k] = wanted.push;
#else
    delta[c.a] = da + wanted.push * xa.w;
    delta[c.b] = db - wanted.push * xb.w;
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!wanted.usable && xa.w + xb.w > real(0) && c.rest_length > real(0), events,
                       TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
