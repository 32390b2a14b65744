// XPBD distance constraint, one invocation per constraint of one colour (no two share a vertex).
//
// Based on:
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `scale`, eq. 26 for
//     the variants with a damper (DAMPED).
//   Macklin et al. Small Steps in Physics Simulation. SCA 2019: one iteration per substep, where the
//   multiplier starts at zero and needs no buffer (the variant without LAMBDA).
// Departures: works on displacements of the substep (`delta`), not on positions, so that many
//   substeps do not lose to rounding; coincident ends are skipped and counted.
// Bytes per element: 16 constraint + 64 read + 32 written (float).
//! lanes
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
//! variant damped DAMPED=1
//! variant damped_lambda DAMPED=1 LAMBDA=1
//! variant damped_tail DAMPED=1 TAIL=1
//! variant damped_tail_lambda DAMPED=1 TAIL=1 LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"

PARAMS
{
    uint first;           // first constraint of the colour; in the tail variant the table's first range
    uint count;           // constraints of the colour; groups in the tail variant
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count degenerate constraints
};

READ(0, DistanceConstraint, constraint);
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
UPDATE(6, real, multiplier); // N s^2
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

// Whole rvec4 operations and one division: what several lanes do best, and one does not worse.
void project(ELEMENT k)
{
    DistanceConstraint c = constraint[k];
    rvec4 xa = position[c.a];
    rvec4 xb = position[c.b];
    rvec4 d = xa - xb;
    real wa = xa.w;
    real wb = xb.w;
    rvec4 da = delta[c.a];
    rvec4 db = delta[c.b];
    rvec4 apart = da - db;
    d += apart;
    real len = length(rvec3(d));
    real scaled = scaled_compliance(c.compliance, step_values[0].inverse_substep);
    real weight = wa + wb;
#if DAMPED
    real damper = min(damping_time[k] * step_values[0].inverse_substep, REAL(1e30)); // gamma of eq. 26
    weight += weight * damper;
#endif
    real denominator = (weight + scaled) * len;
    rbool usable = denominator > REAL(1e-30); // coincident or held ends have none; smaller would overflow
    real value = c.rest_length - len;
#if LAMBDA
    real before = first_iteration != 0u ? real(0) : multiplier[k];
    value -= scaled * before;
#endif
#if DAMPED
    // By how much the ends went apart since the start of the substep; dropped where len is zero.
    value -= SELECT(usable, damper * (dot(rvec3(d), rvec3(apart)) / len), real(0));
#endif
    real scale = value / denominator; // dlambda / len
    scale = SELECT(usable, scale, real(0));
#if LAMBDA
    multiplier[k] = before + scale * len;
#endif
    rvec4 push = d * scale;
    push.w = real(0); // delta keeps its own
    delta[c.a] = da + push * wa;
    delta[c.b] = db - push * wb;
    if (report != 0u)
        COUNT_EVENT_IF(!usable && wa + wb > real(0) && c.rest_length > real(0), events,
                       TAUT_EVENT_DEGENERATE);
}

#include "shared/sweep.glsl"
