// Gives each body that nothing holds the angular momentum back that a substep's solve took (momentum_sum), by
// a velocity w x r about its centre of mass, which keeps its momentum: w of I w = what lacks. One group per
// part of a body; every group of a body adds up the sums alike.
//
// Based on: Goldstein, Poole, Safko. Classical Mechanics, 3rd ed. 2002, 5.3.
// Departures: at most 0.002 rad an iteration are given back, and the rest is owed: a tangle that has to turn
//   inside out finds its shape less often where it may not turn meanwhile.
//   The displacement stays as the solve left it: a body that starts flat or inverted has places from which no
//   turn would reach the angular momentum, but always a velocity. It becomes one by what the displacement
//   begins from (`low`), which `finish` takes off.
// Bytes per row: 4 + 48 read, 16 written (float).
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/layouts.h"
#include "shared/rigid_turn.glsl"

PARAMS
{
    uint groups;
};

READ(0, uint, row);       // as in momentum_sum
READ(1, real, sums);      // of momentum_sum
READ(2, rvec4, position); // m
READ(3, rvec4, delta);    // m
UPDATE(4, rvec4, low);    // m
UPDATE(5, rvec4, owed);   // m^2/s, over mass, at a group's first vertex; alike for all groups of a body
READ_ONE(6, StepValues, step_values);

SHARED(real, sum, 835); // behind the sums what is owed

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = TAUT_BODY_PART * mine;
    uint rows = TAUT_BODY_PART * groups;
    uint first = row[rows + row[own + 1u]];
    PHASE_BEGIN
    if (lane < 3u)
        sum[832u + lane] = owed[first][lane];
    CLEAR_BODY_SUM(TAUT_MOMENTUM_SUMS)
    for (uint j = row[own + 3u] + lane; j < row[own + 4u]; j += 64u)
        for (uint k = 0u; k < TAUT_MOMENTUM_SUMS; ++k)
            sum[TAUT_MOMENTUM_SUMS * lane + k] += sums[TAUT_MOMENTUM_SUMS * j + k];
    PHASE_END
    SUM_BODY_LANES(TAUT_MOMENTUM_SUMS)
    real h = step_values[0].substep;
    PRECISE rvec3 lack = rvec3(sum[1], sum[2], sum[3]) / sum[0] + rvec3(sum[832], sum[833], sum[834]) * h;
    PRECISE rvec3 centre = rvec3(sum[4], sum[5], sum[6]) / sum[0];
    PRECISE rvec3 square = rvec3(sum[7], sum[8], sum[9]) / sum[0];
    PRECISE rvec3 mixed = rvec3(sum[10], sum[11], sum[12]) / sum[0];
    PRECISE rvec3 turn = rigid_turn(lack, centre, square, mixed);
    PRECISE real size = sqrt(dot(turn, turn));
    bool moves = group < groups && size < REAL(1e18);
    PRECISE real share = size > REAL(0.002) ? REAL(0.002) / size : real(1);
    turn *= share;
    LANES_BEGIN(1)
    if (group < groups)
        owed[first] = rvec4(moves ? lack * ((real(1) - share) / h) : rvec3(real(0)), real(0));
    LANES_END
    rvec3 origin = rvec3(position[row[own]]);
    uint last = moves ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[rows + uint(i)];
    PRECISE rvec3 r = rvec3(position[v]) - origin + rvec3(delta[v]) - centre;
    low[v] = low[v] - rvec4(cross(turn, r), real(0));
    EACH_END
}
