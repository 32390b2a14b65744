// Gives each body that nothing holds the momentum and the angular momentum that it must have after the sweeps
// (vbd_drift), by moving and turning it as a whole: no element changes its shape, and of all such moves this
// one lowers the incremental potential most. One group per part of a body; every group of a body adds up the
// sums alike.
//
// Based on: Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM
//   1987: an error along known directions is taken out exactly (here the rigid motions of a body).
// Departures: the turn is found for small angles and made by Cayley's transform, which is a rotation for any:
//   with b half the angle times the axis, r becomes r + 2 / (1 + |b|^2) (b x r + b x (b x r)). Of a body that
//   lies on a line only the momentum is set.
//   A body with contacts moves as shared/vbd_wrench.glsl says; of one that colliders pushed after the sweeps
//   alone, the way along that push is left as it is.
// Bytes per row: 8 + 32 read, 16 written (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/rigid_turn.glsl"
#include "shared/vbd_parts.h"
#include "shared/vbd_wrench.glsl"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint words; // of a row
    uint frame; // as in vbd_rise
};

READ(0, uint, row);       // as in vbd_rise
READ(1, real, sums);      // of vbd_drift
UPDATE(2, rvec4, delta);  // m
READ(3, rvec4, position); // m
#if CONTACT
READ(4, uint, seen);   // as in vbd_start
UPDATE(5, real, lost); // as vbd_limit leaves it
#include "shared/vbd_frame.glsl"
#endif

SHARED(real, sum, 1216);
SHARED(real, total, TAUT_VBD_PARTS); // of the body
#define TOTAL(at) rvec3(total[at], total[(at) + 1u], total[(at) + 2u])
#define TOUCHED(at) TOTAL(TAUT_VBD_DRIFT + at)
#define RUBBED(at) TOTAL(TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + at)

/// Of the sums from `middle`, `square` and `mixed` on, which have that weight.
#define MOMENTS(out_moments, of, middle_at, square_at, mixed_at, weight) \
    out_moments.middle = of(middle_at) / weight;                         \
    out_moments.square = of(square_at) / weight;                         \
    out_moments.mixed = of(mixed_at) / weight;

Whole whole_body()
{
    Whole body;
    PRECISE real weight = total[0];
    PRECISE rvec3 lack = TOTAL(TAUT_VBD_LACK) / weight;
    PRECISE rvec3 turn = TOTAL(TAUT_VBD_TURN) / weight;
    body.lack = lack;
    body.turn = turn;
    body.moved = body.moved_turn = rvec3(real(0));
    MOMENTS(body, TOTAL, TAUT_VBD_PLACE, TAUT_VBD_SQUARE, TAUT_VBD_MIXED, weight)
#if CONTACT
    body.moved = RUBBED(TAUT_VBD_MOVED) / weight;
    body.moved_turn = RUBBED(TAUT_VBD_MOVED_TURN) / weight;
#endif
    return body;
}

#if CONTACT
Feet feet_of_body()
{
    Feet feet;
    feet.push = TOUCHED(TAUT_VBD_PUSH);
    feet.size = total[TAUT_VBD_DRIFT + TAUT_VBD_SIZE];
    feet.hold = total[TAUT_VBD_DRIFT + TAUT_VBD_HOLD];
    feet.height = total[TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + TAUT_VBD_HEIGHT] / feet.size;
    feet.slip = RUBBED(TAUT_VBD_SLIP) / feet.size;
    feet.slip_turn = RUBBED(TAUT_VBD_SLIP_TURN) / feet.size;
    feet.rub = RUBBED(TAUT_VBD_RUB);
    feet.rub_turn = RUBBED(TAUT_VBD_RUB_TURN);
    PRECISE real count = total[TAUT_VBD_DRIFT + TAUT_VBD_COUNT];
    MOMENTS(feet, TOUCHED, TAUT_VBD_FEET, TAUT_VBD_FEET_SQUARE, TAUT_VBD_FEET_MIXED, count)
    return feet;
}
#endif

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint from = row[own + 3u];
    SUM_BODY_PARTS(TAUT_VBD_DRIFT, sums, 0u, TAUT_VBD_PARTS, from, row[own + 4u])
    LANES_BEGIN(TAUT_VBD_DRIFT)
    total[lane] = sum[lane];
    LANES_END
#if CONTACT
    SUM_BODY_PARTS(TAUT_VBD_TOUCH, sums, TAUT_VBD_DRIFT, TAUT_VBD_PARTS, from, row[own + 4u])
    LANES_BEGIN(TAUT_VBD_TOUCH)
    total[TAUT_VBD_DRIFT + lane] = sum[lane];
    LANES_END
    SUM_BODY_PARTS(TAUT_VBD_RUBBING, sums, TAUT_VBD_DRIFT + TAUT_VBD_TOUCH, TAUT_VBD_PARTS, from,
                   row[own + 4u])
    LANES_BEGIN(TAUT_VBD_RUBBING)
    total[TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + lane] = sum[lane];
    LANES_END
#endif
    Whole body = whole_body();
    Shift shift = free_shift(body);
#if CONTACT
    rvec3 pushed = TOUCHED(TAUT_VBD_PUSHED);
    real square = dot(pushed, pushed);
    bool touched = seen[2u * row[words * row[own]] + 1u] != 0u && square > real(0);
    if (total[TAUT_VBD_DRIFT + TAUT_VBD_SIZE] > real(0))
        shift = supported_shift(body, feet_of_body());
    else if (touched) // by what the sweeps do not know of
        shift.way -= pushed * (dot(shift.way, pushed) / square);
    bool judged = is_carried(frame + TAUT_VBD_FRAME * mine) && row[own + 5u] == 0u;
    rvec3 fall = rvec3(sums[TAUT_VBD_PARTS * groups], sums[TAUT_VBD_PARTS * groups + 1u],
                       sums[TAUT_VBD_PARTS * groups + 2u]);
    PRECISE real added = energy_of(shift, body, fall) * total[0];
#endif
    rvec3 way = shift.way;
    rvec3 half_turn = shift.turn * real(0.5);
    PRECISE real size = dot(half_turn, half_turn);
    half_turn *= size > REAL(0.0625) ? real(0.25) / sqrt(size) : real(1);
    PRECISE real factor = real(2) / (real(1) + dot(half_turn, half_turn));
    bool moves = group < groups && row[own + 5u] == 0u && abs(way.x) + abs(way.y) + abs(way.z) < REAL(1e18);
    uint base = row[words * row[own]];
    uint last = moves ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[words * row[rows + uint(i)]];
    PRECISE rvec3 r = rvec3(position[v] - position[base]) + rvec3(delta[v]) - shift.centre;
    PRECISE rvec3 around = cross(half_turn, r);
    around = factor * (around + cross(half_turn, around));
    delta[v] = delta[v] + rvec4(way + around, real(0));
    EACH_END
#if CONTACT
    // What the sweeps took of this motion may be in the elements by now: then it is there twice, and owed.
    LANES_BEGIN(1)
    if (group < groups && judged && IS_FINITE(added))
        lost[mine] = lost[mine] - max(added, real(0));
    LANES_END
#endif
}
