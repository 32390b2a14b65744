// Moves the vertices of closed surfaces so that the volume within is that at rest at the end of the step, to
// first order: one multiplier a surface, no linear solver. Every group adds up its surface's sums itself, in
// the same order, and moves its own vertices.
//
// Based on:
//   Va, Choi, Hong, as surface_volume_sum: one constraint a surface by implicit enforcement.
//   Hong, Choi, Jung, Welch, Trapp. Effective Constrained Dynamic Simulation Using Implicit Constraint
//     Enforcement. ICRA 2005: (J W J^T) lambda = C / h^2 + J (v / h + W F), one row: C = V - V0, J = g.
//   Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016: the compliance.
// Departures: corrects the displacement that forces and velocities have led to, which is the same with
//   L = h^2 lambda: L = (C + g . moved) / (sum w |g|^2 + alpha / h^2), moved -= L w g. Further iterations
//   start from the new places, where the rest of a compliant constraint is C - alpha / h^2 L (KEPT).
//   A surface without a gradient is left alone and counted.
// Bytes per vertex: 4 + 16 + 16 read, 16 written; per group of its surface 12 (float).
//! variant kept KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/compliance.glsl"

PARAMS
{
    uint groups;
    uint surfaces;
    uint iteration; // of the substep; above 0 the sums are at the places that the displacement leads to
    uint report;    // 1: count surfaces without a gradient
};

READ(0, uint, table);     // as in surface_volume_sum.comp
READ(1, real, surface);   // 2 a surface: V at rest [m^3], compliance [m^6/J], 0 = rigid
READ(2, rvec4, gradient); // m^2; w = inverse mass
READ(3, real, partials);  // 3 a group
READ_ONE(4, StepValues, step_values);
UPDATE(5, rvec4, delta); // m
COUNTERS(6, events);
#if KEPT
UPDATE(7, real, multiplier); // J s^2 / m^3; a row of surfaces an iteration and one more, the first of zeros
#endif

SHARED(real, volume, TAUT_LINEAR_GROUP);
SHARED(real, change, TAUT_LINEAR_GROUP);
SHARED(real, weight, TAUT_LINEAR_GROUP);
SHARED(real, pull, 1);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint own = 6u * min(group, groups - 1u);
    uint first = table[own];
    uint end = group < groups ? table[own + 1u] : first;
    uint body = table[own + 3u];
    uint from = table[own + 4u];
    uint shares = table[own + 5u];
    PHASE_BEGIN
    volume[lane] = real(0);
    change[lane] = real(0);
    weight[lane] = real(0);
    PHASE_END
    EACH_BEGIN(from, from + shares)
    volume[lane] += partials[3u * i];
    change[lane] += partials[3u * i + 1u];
    weight[lane] += partials[3u * i + 2u];
    EACH_END
    SUM_LANES_2(volume, change)
    SUM_LANES(weight)
    LANES_BEGIN(1)
    real value = volume[0] - surface[2u * body];
    value += iteration == 0u ? change[0] : real(0);
    real soft = scaled_compliance(surface[2u * body + 1u], step_values[0].inverse_substep);
#if KEPT
    real before = multiplier[iteration * surfaces + body];
    value -= soft * before;
#endif
    bool usable = weight[0] > real(0);
    pull[0] = usable ? value / (weight[0] + soft) : real(0);
    if (group < groups && group == from)
    {
#if KEPT
        multiplier[(iteration + 1u) * surfaces + body] = before + pull[0];
#endif
        if (report != 0u && !usable)
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
    LANES_END
    EACH_BEGIN(first, end)
    uint v = table[6u * groups + 2u * uint(i)];
    rvec4 g = gradient[i];
    rvec4 d = delta[v];
    delta[v] = rvec4(rvec3(d) - rvec3(g) * (g.w * pull[0]), d.w);
    EACH_END
}
