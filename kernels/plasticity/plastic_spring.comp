// Springs that keep a part of their strain: the rest length follows the length where the elastic strain is
// beyond the yield. One invocation per record of a spring that can, at the end of a substep. Where methods
// have two records of one spring, both come to the same bits.
//
// Based on:
//   Mueller, Gross. Interactive Virtual Materials. Graphics Interface 2004, section 4.5: strain is elastic +
//     plastic, and beyond a yield plastic strain grows by creep times time, up to a most.
//   Perzyna. Fundamental Problems in Viscoplasticity. Advances in Applied Mechanics 9, 1966: what grows is
//     what is beyond the yield.
// Departures: so no jump at the yield, and with infinite creep the elastic strain stays at it. What flows in
//   a substep is the exact solution for a spring held at its length (plastic.glsl), so results do not depend
//   on the substep. Strains are relative to the rest length at first. A spring gets no shorter than that over
//   one plus the limit, so that none vanishes.
// Bytes per element: 4 + 16 + 16 spring + 64 read, 4 written (float).
//! variant force FORCE=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/plastic.glsl"

PARAMS
{
    uint count;
};

READ(0, uint, record); // of the springs that can flow
READ(1, real, rule);   // TAUT_PLASTIC_SPRING
#if FORCE
UPDATE(2, Spring, spring);
#else
UPDATE(2, DistanceConstraint, spring);
#endif
READ(3, rvec4, position); // m
READ(4, rvec4, low);      // m
READ_ONE(5, StepValues, step_values);

KERNEL(count)
{
    uint k = record[i];
    uint at = TAUT_PLASTIC_SPRING * uint(i);
    real rest = rule[at];
    real most = real(1) + rule[at + 3u];
    uint a = spring[k].a;
    uint b = spring[k].b;
    rvec3 apart = rvec3(position[a] - position[b]) + rvec3(low[a] - low[b]);
    real before = spring[k].rest_length;
    real strain = (length(apart) - before) / rest;
    real beyond = abs(strain) - rule[at + 1u];
    real flow = (beyond * plastic_share(rule[at + 2u] * step_values[0].substep)) * rest;
    real after = strain > real(0) ? before + flow : before - flow;
    after = min(max(after, rest / most), rest * most);
    if (beyond > real(0))
        spring[k].rest_length = after;
}
