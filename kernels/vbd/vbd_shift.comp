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
//   With CONTACT a body that touched a collider in the substep before is not moved along the push of
//   contacts: what carries it is not in the sweeps, and a few feet of many vertices could not stop it.
// Bytes per row: 8 + 32 read, 16 written (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/rigid_turn.glsl"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint words; // of a row
};

READ(0, uint, row);       // as in vbd_rise
READ(1, real, sums);      // of vbd_drift
UPDATE(2, rvec4, delta);  // m
READ(3, rvec4, position); // m
#if CONTACT
READ(4, uint, seen); // as in vbd_start
#endif

SHARED(real, sum, 1216);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint from = row[own + 3u];
    PHASE_BEGIN
    for (uint k = 0u; k < TAUT_VBD_DRIFT; ++k)
        sum[TAUT_VBD_DRIFT * lane + k] = real(0);
    for (uint j = from + lane; j < row[own + 4u]; j += 64u)
        for (uint k = 0u; k < TAUT_VBD_DRIFT; ++k)
            sum[TAUT_VBD_DRIFT * lane + k] += sums[TAUT_VBD_DRIFT * j + k];
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        for (uint k = 0u; k < TAUT_VBD_DRIFT; ++k)
            sum[TAUT_VBD_DRIFT * lane + k] += sum[TAUT_VBD_DRIFT * (lane + width) + k];
        LANES_END
    }
    PRECISE rvec3 way = rvec3(sum[1], sum[2], sum[3]) / sum[0];
    PRECISE rvec3 centre = rvec3(sum[4], sum[5], sum[6]) / sum[0];
    PRECISE rvec3 turn = rvec3(sum[7], sum[8], sum[9]) / sum[0] - cross(centre, way);
    PRECISE rvec3 square = rvec3(sum[10], sum[11], sum[12]) / sum[0];
    PRECISE rvec3 mixed = rvec3(sum[13], sum[14], sum[15]) / sum[0];
    PRECISE rvec3 half_turn = rigid_turn(turn, centre, square, mixed) * real(0.5);
    PRECISE real size = dot(half_turn, half_turn);
    half_turn *= size > REAL(0.0625) ? real(0.25) / sqrt(size) : real(1);
    PRECISE real factor = real(2) / (real(1) + dot(half_turn, half_turn));
#if CONTACT
    PRECISE rvec3 push = rvec3(sum[16], sum[17], sum[18]);
    PRECISE real pushed = dot(push, push);
    bool touches = seen[2u * row[words * row[own]] + 1u] != 0u && pushed > real(0);
    way -= touches ? push * (dot(way, push) / pushed) : rvec3(real(0));
#endif
    bool moves = group < groups && row[own + 5u] == 0u && abs(way.x) + abs(way.y) + abs(way.z) < REAL(1e18);
    uint base = row[words * row[own]];
    uint last = moves ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[words * row[rows + uint(i)]];
    PRECISE rvec3 r = rvec3(position[v] - position[base]) + rvec3(delta[v]) - centre;
    PRECISE rvec3 around = cross(half_turn, r);
    around = factor * (around + cross(half_turn, around));
    delta[v] = delta[v] + rvec4(way + around, real(0));
    EACH_END
}
