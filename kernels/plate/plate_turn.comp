// The turn that each hinge of a plate shares out to its two triangles, at the end of a substep. One
// invocation per hinge:
//
//   b_t = p_t + s_t a m,   m = -lambda / h^2,   s_0 + s_1 = 1.
//
// m is the moment that the hinge had in the substep and a its compliance, so that b_0 + b_1 = theta - theta0
// where the hinge is solved. p_t is where the triangle's end of the edge would go by itself (plate_rest), s_t
// the share of its softness.
//
// Based on: Morley. The Triangular Equilibrium Element in the Solution of Plate Bending Problems.
//   Aeronautical Quarterly 19, 1968: the unknown is a turn at each edge; Lange, Optimization, 2nd ed., 2013,
//   chapter 8 (majorization and minimization: energy never rises).
// Departures: turns b at both sides of an edge stand for Morley's one. They follow the moment, not the angle:
//   of a hinge that one sweep does not solve the angle says nothing of the moment, and turns by it would
//   store energy that nothing paid for.
// Bytes per hinge: 4 + 24 + 4 + 4 + 8 read, 8 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"
#include "shared/plate_rule.h"

PARAMS
{
    uint count;
};

READ(0, uint, record);             // of the hinge, in `hinge` and `multiplier`
READ(1, BendingConstraint, hinge); // its compliance, rad^2/J
READ(2, real, multiplier);         // lambda, J s^2
READ_ONE(3, StepValues, step_values);
READ(4, real, rule);               // shared/plate_rule.h
READ(5, real, pull);               // p of both sides, rad
WRITE(6, real, turn);              // b of both sides, rad

KERNEL(count)
{
    uint k = record[i];
    real bent = -scaled_compliance(hinge[k].compliance, step_values[0].inverse_substep) * multiplier[k];
    real share = rule[TAUT_PLATE_RULE * uint(i) + 1u];
    turn[2u * uint(i)] = pull[2u * uint(i)] + share * bent;
    turn[2u * uint(i) + 1u] = pull[2u * uint(i) + 1u] + (real(1) - share) * bent;
}
