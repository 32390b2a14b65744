// XPBD volume of a tetrahedron, one invocation per tetrahedron of one colour (no two share a vertex).
//
// Based on:
//   Mueller, Chentanez, Kim, Macklin. Strain Based Dynamics. SCA 2014, and Mueller, Heidelberger, Hennix,
//     Ratcliff. Position Based Dynamics. 2007: C = V - V0 with the signed volume, its gradients a sixth of
//     the cross products of edges.
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `dlambda`.
// Departures: works on displacements of the substep (`delta`), as distance.comp; a tetrahedron collapsed to a
//   line has no gradient: skipped, counted.
// Bytes per element: 24 constraint + 128 read + 64 written (float).
//! lanes
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"

PARAMS
{
    uint first;           // first constraint of the colour; in the tail variant the table's first range
    uint count;           // constraints of the colour; groups in the tail variant
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count degenerate tetrahedra
};

READ(0, VolumeConstraint, constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(5, uint, table);          // as in distance.comp
#else
UPDATE(2, rvec4, delta);
#endif
#if LAMBDA
#if TAIL
UPDATE(6, real, multiplier); // J s^2 / m^3
#else
UPDATE(5, real, multiplier);
#endif
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
    rvec3 e1 = rvec3((p1 - p0) + (d1 - d0));
    rvec3 e2 = rvec3((p2 - p0) + (d2 - d0));
    rvec3 e3 = rvec3((p3 - p0) + (d3 - d0));
    // Six times the gradients; their sixth goes into `weight` and the pushes.
    rvec3 g1 = cross(e2, e3);
    rvec3 g2 = cross(e3, e1);
    rvec3 g3 = cross(e1, e2);
    rvec3 g0 = -((g1 + g2) + g3);
    real volume = dot(e1, g1) * REAL(0.16666666666666666667);
    real weight = (((p0.w * dot(g0, g0) + p1.w * dot(g1, g1)) + p2.w * dot(g2, g2)) + p3.w * dot(g3, g3)) *
                  REAL(0.027777777777777777778);
    real scaled = scaled_compliance(c.compliance, step_values[0].inverse_substep);
    rbool usable = weight > real(0);
    real total = SELECT(usable, weight + scaled, real(1));
    real value = c.rest_volume - volume;
#if LAMBDA
    real before = first_iteration != 0u ? real(0) : multiplier[k];
    value -= scaled * before;
    real dlambda = SELECT(usable, value / total, real(0));
    multiplier[k] = before + dlambda;
#else
    real dlambda = SELECT(usable, value / total, real(0));
#endif
    real sixth = dlambda * REAL(0.16666666666666666667);
    delta[c.a] = d0 + rvec4(g0 * (p0.w * sixth), real(0));
    delta[c.b] = d1 + rvec4(g1 * (p1.w * sixth), real(0));
    delta[c.c] = d2 + rvec4(g2 * (p2.w * sixth), real(0));
    delta[c.d] = d3 + rvec4(g3 * (p3.w * sixth), real(0));
    if (report != 0u)
        COUNT_EVENT_IF(!usable && ((p0.w + p1.w) + p2.w) + p3.w > real(0), events, TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
