// XPBD of elements of two corners at one vertex that has very many: solved at once (Jacobi) by one group, the
// hub's mass split among them, so that a star of 10,000 springs is one dispatch and not 10,000 colours.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012: each constraint sees the hub with 1/n of its mass; the copies are then averaged.
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `dlambda`.
// Departures: none. The sum over the constraints is a fixed tree, so the result does not vary.
// Bytes per constraint: 16 + 32 read, 16 written (float), besides the hub itself.
//! each element of xpbd_hub
//! variant lambda LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"
#include "shared/element.glsl"
#include TAUT_ELEMENT

PARAMS
{
    uint first;
    uint count;           // elements at the hub; the hub is corner 0 of each
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count elements without a gradient
};

READ(0, OF_ELEMENT(record), constraint);
READ(1, rvec4, position);
UPDATE(2, rvec4, delta);
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
#if LAMBDA
UPDATE(5, real, multiplier);
#endif

SHARED(rvec4, partial, 64);

GROUP_KERNEL(64)
{
    PHASE_BEGIN
    rvec3 sum = rvec3(real(0));
    for (uint k = first + lane; k < first + count; k += 64u)
    {
        OF_ELEMENT(record) c = constraint[k];
        rvec4 x0 = position[OF_ELEMENT(v0)(c)];
        rvec4 x1 = position[OF_ELEMENT(v1)(c)];
        rvec4 d1 = delta[OF_ELEMENT(v1)(c)];
        rvec3 e1 = rvec3(x1 - x0) + rvec3(d1 - delta[OF_ELEMENT(v0)(c)]);
        ElementRow row = OF_ELEMENT(row)(c, e1);
        real scaled = scaled_compliance(row.compliance, step_values[0].inverse_substep);
        real weight = (x0.w * real(count)) * row.s0 + x1.w * row.s1;
        bool usable = row.shaped && weight > real(0);
#if LAMBDA
        real before = first_iteration != 0u ? real(0) : multiplier[k];
        real dlambda = usable ? -(row.value + scaled * before) / (weight + scaled) : real(0);
        multiplier[k] = before + dlambda;
#else
        real dlambda = usable ? -row.value / (weight + scaled) : real(0);
#endif
        rvec3 push = usable ? row.g1 * (dlambda / row.divisor) : rvec3(real(0));
        delta[OF_ELEMENT(v1)(c)] = d1 + rvec4(x1.w * push, real(0));
        sum -= x0.w * push;
        if (report != 0u && !usable && row.counted && weight > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
    partial[lane] = rvec4(sum, real(0));
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        PHASE_BEGIN
        if (lane < width)
            partial[lane] += partial[lane + width];
        PHASE_END
    }
    PHASE_BEGIN
    if (lane == 0u)
    {
        uint hub = OF_ELEMENT(v0)(constraint[first]);
        delta[hub] = delta[hub] + partial[0];
    }
    PHASE_END
}
