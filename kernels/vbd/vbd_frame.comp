// The rigid motion of what carries a body in a substep, fitted to the surfaces below its guess (vbd_carry).
// One group per part of a body; every group of a body adds up the sums alike.
//
// Based on: Goldstein, Poole, Safko. Classical Mechanics, 3rd ed. 2002, 5.3 (shared/rigid_turn.glsl).
// Departures: surfaces that touch in a point or along a line turn nothing.
// Bytes per group: 64 read, 40 written (float).
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/rigid_turn.glsl"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint carry; // where in `sums` those of vbd_carry are, and behind them the frames
};

READ(0, uint, row);    // as in vbd_rise
UPDATE(1, real, sums); // TAUT_VBD_FRAME a group

SHARED(real, sum, 1024);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint from = row[own + 3u];
    SUM_BODY_PARTS(TAUT_VBD_DRIFT, sums, carry, TAUT_VBD_DRIFT, from, row[own + 4u])
    LANES_BEGIN(1)
    real weight = sum[0] > real(0) ? sum[0] : real(1);
    PRECISE rvec3 way = rvec3(sum[1], sum[2], sum[3]) / weight;
    PRECISE rvec3 centre = rvec3(sum[4], sum[5], sum[6]) / weight;
    PRECISE rvec3 turn = rvec3(sum[7], sum[8], sum[9]) / weight - cross(centre, way);
    PRECISE rvec3 square = rvec3(sum[10], sum[11], sum[12]) / weight;
    PRECISE rvec3 mixed = rvec3(sum[13], sum[14], sum[15]) / weight;
    rvec3 angle = rigid_turn(turn, centre, square, mixed);
    if (group < groups)
    {
        uint at = carry + TAUT_VBD_DRIFT * groups + TAUT_VBD_FRAME * mine;
        sums[at] = sum[0] > real(0) ? real(1) : real(0);
        for (int c = 0; c < 3; ++c)
        {
            sums[at + 1u + uint(c)] = way[c];
            sums[at + 4u + uint(c)] = centre[c];
            sums[at + 7u + uint(c)] = angle[c];
        }
    }
    LANES_END
}
