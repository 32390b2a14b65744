// The gas within closed surfaces presses on their vertices: a velocity for each, before the inertial guess.
// Every group adds up its surface's volume itself, in the same order, and pushes its own vertices.
//
// Based on:
//   Matyka, Ollila. Pressure Model of Soft Body Simulation. SIGRAD 2003: the force p(V) n A / 3 of a triangle
//     on each of its corners, p of an ideal gas.
// Departures: p is what the gas presses more than the air outside, p_0 at the volume at rest; the sum of
//   n A / 3 over the triangles at a vertex is the gradient of the volume there (surface_volume_sum.comp).
//   What an isothermal gas presses grows to 100 p_0 and no further: beyond, the volume is next to none or has
//   the other sign, and the case is counted.
// Bytes per vertex: 4 + 16 + 16 read, 16 written; per group of its surface 4 (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint groups;
    uint report; // 1: count surfaces that enclose too little
};

READ(0, uint, table);   // as in surface_volume_sum.comp
READ(1, real, surface); // 3 a surface: V at rest [m^3], p_0 [Pa] with the sign of V, 1 = isothermal or 0
READ(2, rvec4, gradient); // m^2; w = inverse mass
READ(3, real, partials);  // 3 a group, the first is of V
READ_ONE(4, StepValues, step_values);
UPDATE(5, rvec4, velocity); // m/s
COUNTERS(6, events);

SHARED(real, volume, TAUT_LINEAR_GROUP);
SHARED(real, push, 1);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint own = 6u * min(group, groups - 1u);
    uint first = table[own];
    uint end = group < groups ? table[own + 1u] : first;
    uint body = 3u * table[own + 3u];
    uint from = table[own + 4u];
    uint shares = table[own + 5u];
    CLEAR_LANES(volume)
    EACH_BEGIN(from, from + shares)
    volume[lane] += partials[3u * i];
    EACH_END
    SUM_LANES(volume)
    LANES_BEGIN(1)
    real share = volume[0] / surface[body];
    bool isothermal = surface[body + 2u] > real(0);
    bool usable = share >= REAL(0.01);
    real grown = usable ? real(1) / share : real(100);
    real pressure = isothermal ? surface[body + 1u] * grown : surface[body + 1u];
    push[0] = pressure * step_values[0].substep;
    if (report != 0u)
    {
        if (group < groups && group == from && isothermal && !usable)
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
    LANES_END
    EACH_BEGIN(first, end)
    uint v = table[6u * groups + 2u * uint(i)];
    rvec4 g = gradient[i];
    velocity[v] = rvec4(rvec3(velocity[v]) + rvec3(g) * (g.w * push[0]), real(0));
    EACH_END
}
