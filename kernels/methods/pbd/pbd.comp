// PBD of one element. Coloured: one invocation per element of one colour (no two share a vertex).
// Variant `slots`: one invocation per element of all, which writes what it wants for pbd_average.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006, eqs. 4 and 5.
//   Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics. 2015: colours.
// Departures: see shared/pbd.glsl; works on displacements of the substep (`delta`).
// Bytes per element: its record, 32 read and 16 written a corner (float); slots of two corners: 16 written.
//! each element of pbd
//! lanes
//! variant tail TAIL=1
//! variant slots SLOTS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"
#include TAUT_ELEMENT
#include "shared/element_row.glsl"

PARAMS
{
    uint first;  // first element of the colour; in the tail variant the table's first range
    uint count;  // elements of the colour; groups in the tail variant
    float share; // of a correction that one iteration makes
    uint report; // 1: count elements without a gradient
};

READ(0, OF_ELEMENT(record), constraint); // its compliance is not read
READ(1, rvec4, position);                // xyz m, w = inverse mass 1/kg
COUNTERS(3, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(4, uint, table);          // two words a group, {begin, end}: table[c] for c = begin..end are the
                               // first elements of its colours, and the end of the last
#elif SLOTS
READ(2, rvec4, delta);
WRITE(4, rvec4, correction); // displacement per inverse mass, kg m: correction[corners * element + corner];
                             // of two corners only that of corner 0, since the other's is its negative
#else
UPDATE(2, rvec4, delta);
#endif

INLINE void project(ELEMENT k)
{
    OF_ELEMENT(record) c = constraint[k];
    rvec4 x0 = position[OF_ELEMENT(v0)(c)];
    rvec4 x1 = position[OF_ELEMENT(v1)(c)];
    rvec4 d0 = delta[OF_ELEMENT(v0)(c)];
    rvec4 d1 = delta[OF_ELEMENT(v1)(c)];
    rvec3 e1 = rvec3((x1 - x0) + (d1 - d0));
#if ELEMENT_CORNERS > 2
    rvec4 x2 = position[OF_ELEMENT(v2)(c)];
    rvec4 d2 = delta[OF_ELEMENT(v2)(c)];
    rvec3 e2 = rvec3((x2 - x0) + (d2 - d0));
#endif
#if ELEMENT_CORNERS > 3
    rvec4 x3 = position[OF_ELEMENT(v3)(c)];
    rvec4 d3 = delta[OF_ELEMENT(v3)(c)];
    rvec3 e3 = rvec3((x3 - x0) + (d3 - d0));
#endif
    ElementRow row = OF_ELEMENT(row)(c, ELEMENT_EDGES);
    RowPush push = row_push(row, row_weight(row, ELEMENT_MASSES), real(share));
#ifdef ELEMENT_WITH_BOUNDS
    push = bounded_push(push, row, ELEMENT_MASSES, ELEMENT_EDGES);
#endif
    rvec3 p0 = row.g0 * push.scale;
#if ELEMENT_CORNERS == 2
#if SLOTS
    correction[k] = rvec4(p0, real(0));
#else
    delta[OF_ELEMENT(v0)(c)] = d0 + rvec4(p0 * x0.w, real(0));
    delta[OF_ELEMENT(v1)(c)] = d1 - rvec4(p0 * x1.w, real(0));
#endif
#else
    rvec3 p1 = row.g1 * push.scale;
    rvec3 p2 = row.g2 * push.scale;
#if SLOTS
    correction[uint(ELEMENT_CORNERS) * k] = rvec4(p0, real(0));
    correction[uint(ELEMENT_CORNERS) * k + 1u] = rvec4(p1, real(0));
    correction[uint(ELEMENT_CORNERS) * k + 2u] = rvec4(p2, real(0));
#else
    delta[OF_ELEMENT(v0)(c)] = d0 + rvec4(p0 * x0.w, real(0));
    delta[OF_ELEMENT(v1)(c)] = d1 + rvec4(p1 * x1.w, real(0));
    delta[OF_ELEMENT(v2)(c)] = d2 + rvec4(p2 * x2.w, real(0));
#endif
#endif
#if ELEMENT_CORNERS > 3
    rvec3 p3 = row.g3 * push.scale;
#if SLOTS
    correction[uint(ELEMENT_CORNERS) * k + 3u] = rvec4(p3, real(0));
#else
    delta[OF_ELEMENT(v3)(c)] = d3 + rvec4(p3 * x3.w, real(0));
#endif
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!push.usable && row.counted && ELEMENT_MASS > real(0), events, TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
