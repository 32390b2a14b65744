// XPBD of one element, one invocation per element of one colour (no two share a vertex):
//   dlambda = -(C + a lambda) / (sum w_i |grad_i C|^2 + a), a = compliance / h^2;
//   x_i += w_i grad_i C dlambda.
// With dampers (DAMPED), gamma = damping time / h:
//   dlambda = -(C + a lambda + gamma grad C . (x - x_n)) / ((1 + gamma) sum w_i |grad_i C|^2 + a).
//
// Based on:
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18, with dampers eq. 26.
//   Macklin et al. Small Steps in Physics Simulation. SCA 2019: one iteration per substep, where the
//   multiplier starts at zero and needs no buffer (the variant without LAMBDA).
// Departures: works on displacements of the substep (`delta`), not on positions, so that many substeps do not
//   lose to rounding; the element's divisor goes into the one division; elements without a gradient are
//   skipped and counted.
// Bytes per element: its record, 32 read and 16 written a corner (float).
//! each element of xpbd
//! lanes
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
//! variant damped DAMPED=1 with dampers
//! variant damped_lambda DAMPED=1 LAMBDA=1 with dampers
//! variant damped_tail DAMPED=1 TAIL=1 with dampers
//! variant damped_tail_lambda DAMPED=1 TAIL=1 LAMBDA=1 with dampers
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_row.glsl"

PARAMS
{
    uint first;           // first element of the colour; in the tail variant the table's first range
    uint count;           // elements of the colour; groups in the tail variant
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count elements without a gradient
};

READ(0, OF_ELEMENT(record), constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(5, uint, table);          // two words a group, {begin, end}: table[c] for c = begin..end are the
                               // first elements of its colours, and the end of the last
#else
UPDATE(2, rvec4, delta);
#endif
#if LAMBDA
#if TAIL
UPDATE(6, real, multiplier); // J s^2 over the unit of C
#else
UPDATE(5, real, multiplier);
#endif
#endif
#if DAMPED
#if TAIL && LAMBDA
READ(7, real, damping_time); // damper over stiffness, s
#elif TAIL || LAMBDA
READ(6, real, damping_time);
#else
READ(5, real, damping_time);
#endif
#endif

INLINE void project(ELEMENT k)
{
    OF_ELEMENT(record) c = constraint[k];
    rvec4 x0 = position[OF_ELEMENT(v0)(c)];
    rvec4 x1 = position[OF_ELEMENT(v1)(c)];
    rvec4 d0 = delta[OF_ELEMENT(v0)(c)];
    rvec4 d1 = delta[OF_ELEMENT(v1)(c)];
    rvec3 e1 = rvec3((x1 - x0) + (d1 - d0));
    real masses = x0.w + x1.w;
#if ELEMENT_CORNERS > 2
    rvec4 x2 = position[OF_ELEMENT(v2)(c)];
    rvec4 d2 = delta[OF_ELEMENT(v2)(c)];
    rvec3 e2 = rvec3((x2 - x0) + (d2 - d0));
    masses += x2.w;
#endif
#if ELEMENT_CORNERS > 3
    rvec4 x3 = position[OF_ELEMENT(v3)(c)];
    rvec4 d3 = delta[OF_ELEMENT(v3)(c)];
    rvec3 e3 = rvec3((x3 - x0) + (d3 - d0));
    masses += x3.w;
#endif
    ElementRow row = OF_ELEMENT(row)(c, ELEMENT_EDGES);
    real weight = x0.w * row.s0 + x1.w * row.s1;
#if ELEMENT_CORNERS > 2
    weight += x2.w * row.s2;
#endif
#if ELEMENT_CORNERS > 3
    weight += x3.w * row.s3;
#endif
    real value = row.value;
    rbool usable = row.shaped && weight > real(0); // held vertices alone may carry the gradient
#if DAMPED
    real damper = min(damping_time[k] * step_values[0].inverse_substep, REAL(1e30)); // gamma
    real change = dot(row.g1, rvec3(d1 - d0)); // of C since the start of the substep, times the divisor
#if ELEMENT_CORNERS > 2
    change += dot(row.g2, rvec3(d2 - d0));
#endif
#if ELEMENT_CORNERS > 3
    change += dot(row.g3, rvec3(d3 - d0));
#endif
    value += SELECT(usable, damper * (change / row.divisor), real(0));
    weight += weight * damper;
#endif
    real scaled = scaled_compliance(row.compliance, step_values[0].inverse_substep);
#if LAMBDA
    real before = first_iteration != 0u ? real(0) : multiplier[k];
    value += scaled * before;
#endif
    real denominator = (weight + scaled) * row.divisor;
    usable = usable && denominator > REAL(1e-30); // smaller would overflow
    real scale = SELECT(usable, -value / SELECT(usable, denominator, real(1)), real(0)); // dlambda / divisor
#if LAMBDA
    multiplier[k] = before + scale * row.divisor;
#endif
#if ELEMENT_CORNERS == 2
    rvec3 push = row.g1 * scale; // the other end's is the opposite
    delta[OF_ELEMENT(v0)(c)] = d0 - rvec4(push * x0.w, real(0));
    delta[OF_ELEMENT(v1)(c)] = d1 + rvec4(push * x1.w, real(0));
#else
    delta[OF_ELEMENT(v0)(c)] = d0 + rvec4(row.g0 * (x0.w * scale), real(0));
    delta[OF_ELEMENT(v1)(c)] = d1 + rvec4(row.g1 * (x1.w * scale), real(0));
    delta[OF_ELEMENT(v2)(c)] = d2 + rvec4(row.g2 * (x2.w * scale), real(0));
#endif
#if ELEMENT_CORNERS > 3
    delta[OF_ELEMENT(v3)(c)] = d3 + rvec4(row.g3 * (x3.w * scale), real(0));
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!usable && row.counted && masses > real(0), events, TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
