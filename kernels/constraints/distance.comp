// XPBD distance constraint, one invocation per constraint of one colour (no two share a vertex).
//
// Based on:
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `dlambda`.
//   Macklin et al. Small Steps in Physics Simulation. SCA 2019: one iteration per substep, where the
//   multiplier starts at zero and needs no buffer (the variant without LAMBDA).
// Departures: works on displacements of the substep (`delta`), not on positions, so that many
//   substeps do not lose to rounding; coincident ends are skipped and counted.
// Bytes per element: 16 constraint + 64 read + 32 written (float).
//! variant lambda LAMBDA=1
//! variant tail TAIL=1
//! variant tail_lambda TAIL=1 LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint first;           // first constraint of the colour; in the tail variant the table's first range
    uint count;           // constraints of the colour; groups in the tail variant
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count degenerate constraints
};

READ(0, DistanceConstraint, constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ(3, StepValues, step_values);
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

void project(uint k)
{
    DistanceConstraint c = constraint[k];
    rvec4 xa = position[c.a];
    rvec4 xb = position[c.b];
    rvec4 da = delta[c.a];
    rvec4 db = delta[c.b];
    rvec3 d = rvec3(xa - xb) + rvec3(da - db);
    real len = length(d);
    real scaled = c.compliance * step_values[0].inverse_substep * step_values[0].inverse_substep;
    real weight = xa.w + xb.w;
    bool usable = len > real(0) && weight > real(0);
    real value = len - c.rest_length;
#if LAMBDA
    real before = first_iteration != 0u ? real(0) : multiplier[k];
    real dlambda = usable ? -(value + scaled * before) / (weight + scaled) : real(0);
    multiplier[k] = before + dlambda;
#else
    real dlambda = usable ? -value / (weight + scaled) : real(0);
#endif
    rvec3 push = usable ? d * (dlambda / len) : rvec3(real(0));
    delta[c.a] = da + rvec4(xa.w * push, real(0));
    delta[c.b] = db - rvec4(xb.w * push, real(0));
    if (report != 0u && !usable && weight > real(0) && c.rest_length > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
}

#if TAIL
// One group a run of small colours, or a small body: its colours one after another, the same sums in the
// same order as one dispatch a colour.
GROUP_KERNEL(64)
{
    uint begin = table[first + 2u * group];
    // Folded dispatches may bring groups too many; they have no colours.
    uint end = group < count ? table[first + 2u * group + 1u] : begin;
    for (uint colour = begin; colour < end; ++colour)
    {
        PHASE_BEGIN
        for (uint k = table[colour] + lane; k < table[colour + 1u]; k += 64u)
            project(k);
        PHASE_END
    }
}
#else
KERNEL(count)
{
    project(first + i);
}
#endif
