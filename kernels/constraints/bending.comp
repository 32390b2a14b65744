// XPBD dihedral bending, one invocation per hinge of one colour (no two share a vertex).
//
// Based on:
//   Bridson, Marino, Fedkiw. Simulation of Clothing with Folds and Wrinkles. SCA 2003: the four gradients.
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `dlambda`.
// Departures: the angle itself is the constraint, by a two-argument arctangent (acos loses half the
//   digits near flat and has a singular gradient there); the difference to the rest angle is wrapped
//   to (-pi, pi]; a wing whose height is below 1e-6 of its edges has no usable normal: skipped, counted.
// Bytes per element: 24 constraint + 128 read + 64 written (float).
//! lanes
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"
#include "shared/hinge.glsl"

PARAMS
{
    uint first;           // first constraint of the colour; in the tail variant the table's first range
    uint count;           // constraints of the colour; groups in the tail variant
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count degenerate hinges
};

READ(0, BendingConstraint, constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(5, uint, table);          // two words a group, {begin, end}: table[c] for c = begin..end are the
                               // first constraints of its colours, and the end of the last
#else
UPDATE(2, rvec4, delta);
#endif
#if LAMBDA
#if TAIL
UPDATE(6, real, multiplier); // N m s^2
#else
UPDATE(5, real, multiplier);
#endif
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
    rvec3 e = rvec3((p1 - p0) + (d1 - d0));
    rvec3 a = rvec3((p2 - p0) + (d2 - d0));
    rvec3 b = rvec3((p3 - p0) + (d3 - d0));
    real w0 = p0.w;
    real w1 = p1.w;
    real w2 = p2.w;
    real w3 = p3.w;
    HingeShape hinge = hinge_shape(e, a, b);
    real value = angle_difference(hinge.angle, c.rest_angle);
    real weight = w0 * dot(hinge.edge0, hinge.edge0) + w1 * dot(hinge.edge1, hinge.edge1) +
                  w2 * dot(hinge.wing0, hinge.wing0) + w3 * dot(hinge.wing1, hinge.wing1);
    rbool usable = hinge.shaped && weight > real(0); // held vertices alone may carry the gradient
    real scaled = scaled_compliance(c.compliance, step_values[0].inverse_substep);
    real total = SELECT(usable, weight + scaled, real(1));
#if LAMBDA
    real before = first_iteration != 0u ? real(0) : multiplier[k];
    real dlambda = SELECT(usable, -(value + scaled * before) / total, real(0));
    multiplier[k] = before + dlambda;
#else
    real dlambda = SELECT(usable, -value / total, real(0));
#endif
    delta[c.edge0] = d0 + rvec4(hinge.edge0 * (w0 * dlambda), real(0));
    delta[c.edge1] = d1 + rvec4(hinge.edge1 * (w1 * dlambda), real(0));
    delta[c.wing0] = d2 + rvec4(hinge.wing0 * (w2 * dlambda), real(0));
    delta[c.wing1] = d3 + rvec4(hinge.wing1 * (w3 * dlambda), real(0));
    if (report != 0u)
        COUNT_EVENT_IF(!hinge.shaped && w0 + w1 + w2 + w3 > real(0), events, TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
