// PBD volume of a tetrahedron. Coloured: one invocation per tetrahedron of a colour (no two share a vertex).
// Variant `slots`: one invocation per tetrahedron of all, which writes what it wants for pbd_average.
//
// Based on: Va, Choi, Hong. Efficient Simulation of Volumetric Deformable Objects in Unity3D: GPU-Accelerated
//   Position-Based Dynamics. Electronics 12(10), 2023: C = V - V0 with the signed volume.
// Departures: see shared/pbd.glsl; works on displacements of the substep (`delta`).
// Bytes per element: 24 constraint + 128 read + 64 written (float).
//! lanes
//! variant tail TAIL=1
//! variant slots SLOTS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"

PARAMS
{
    uint first;  // first tetrahedron of the colour; in the tail variant the table's first range
    uint count;  // tetrahedra of the colour; groups in the tail variant
    float share; // of a correction that one iteration makes
    uint report; // 1: count degenerate tetrahedra
};

READ(0, VolumeConstraint, constraint); // its compliance is not read
READ(1, rvec4, position);              // xyz m, w = inverse mass 1/kg
COUNTERS(3, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(4, uint, table);          // as in pbd_stretch
#elif SLOTS
READ(2, rvec4, delta);
WRITE(4, rvec4, correction); // displacement per inverse mass, kg m: correction[4 * tetrahedron + corner]
#else
UPDATE(2, rvec4, delta);
#endif

void project(ELEMENT k)
{
    VolumeConstraint c = constraint[k];
    rvec4 p0 = position[c.a];
    rvec4 p1 = position[c.b];
    rvec4 p2 = position[c.c];
    rvec4 p3 = position[c.d];
    rvec4 d0 = delta[c.a];
    rvec4 d1 = delta[c.b];
    rvec4 d2 = delta[c.c];
    rvec4 d3 = delta[c.d];
    VolumePush wanted = volume_push(c, p0, p1, p2, p3, d0, d1, d2, d3, real(share));
#if SLOTS
    correction[4u * k] = rvec4(wanted.a, real(0));
    correction[4u * k + 1u] = rvec4(wanted.b, real(0));
    correction[4u * k + 2u] = rvec4(wanted.c, real(0));
    correction[4u * k + 3u] = rvec4(wanted.d, real(0));
#else
    delta[c.a] = d0 + rvec4(wanted.a * p0.w, real(0));
    delta[c.b] = d1 + rvec4(wanted.b * p1.w, real(0));
    delta[c.c] = d2 + rvec4(wanted.c * p2.w, real(0));
    delta[c.d] = d3 + rvec4(wanted.d * p3.w, real(0));
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!wanted.usable && p0.w + p1.w + p2.w + p3.w > real(0), events,
                       TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
