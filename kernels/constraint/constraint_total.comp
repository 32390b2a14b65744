// Between the solves of one substep: adds what the last one found to the multipliers of the substep, and sets
// the start value of the next: zero, or before the first solve of a substep the whole of the last substep.
// One invocation per row.
//
// Based on: Goldenthal et al. 2007, algorithm 1 (the sum over the solves of a step).
// Departures: the first solve starts warm.
// Bytes per row (float): 8 read, 8 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
    uint first; // 1: before the first solve of a substep
};

UPDATE(0, real, x);          // kg m
UPDATE(1, real, multiplier); // kg m
READ_ONE(2, CgState, state);

KERNEL(count)
{
    // Without a right-hand side the answer was 0, whatever the solve was started from.
    real found = state[0].status == uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE) ? real(0) : x[i];
    real total = multiplier[i] + found;
    x[i] = first != 0u ? total : real(0);
    multiplier[i] = first != 0u ? real(0) : total;
}
