// Distance constraints of one vertex that has very many: solved at once (Jacobi) by one group, with the
// hub's mass split among them, so that a star of 10,000 springs is one dispatch and not 10,000 colours.
//
// Based on: Tonge, Benevolenski, Voroshilov. Mass Splitting for Jitter-Free Parallel Rigid Body Simulation.
//   SIGGRAPH 2012: each constraint sees the hub with 1/n of its mass; the copies are then averaged.
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 18 at `dlambda`.
// Departures: none. The sum over the constraints is a fixed tree, so the result does not vary.
// Bytes per constraint: 16 + 32 read, 16 written (float), besides the hub itself.
//! variant lambda LAMBDA=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"

PARAMS
{
    uint first;
    uint count;           // constraints at the hub; the hub is end `a` of each
    uint first_iteration; // 1: the multiplier starts at zero
    uint report;          // 1: count degenerate constraints
};

READ(0, DistanceConstraint, constraint);
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
        DistanceConstraint c = constraint[k];
        rvec4 xa = position[c.a];
        rvec4 xb = position[c.b];
        rvec4 db = delta[c.b];
        rvec3 d = rvec3(xa - xb) + rvec3(delta[c.a] - db);
        real len = length(d);
        real scaled = scaled_compliance(c.compliance, step_values[0].inverse_substep);
        real weight = xa.w * real(count) + xb.w;
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
        delta[c.b] = db - rvec4(xb.w * push, real(0));
        sum += xa.w * push;
        if (report != 0u && !usable && weight > real(0) && c.rest_length > real(0))
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
        uint hub = constraint[first].a;
        delta[hub] = delta[hub] + partial[0];
    }
    PHASE_END
}
