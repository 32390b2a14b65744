// What the solve of a substep took of the angular momentum of each body that nothing holds: a group's share
// of the sums from which momentum_turn gives it back.
//
// Based on: Newton's third law: what acts between the vertices of a body changes neither its momentum nor its
//   angular momentum. At the end of a substep that is sum m (x + d) x d / h = sum m x x d / h, d being the
//   displacement from x, so the solve must leave sum m x x d as it was.
// Departures: none.
// Bytes per row: 4 + 48 read (float).
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"

PARAMS
{
    uint groups;
};

READ(0, uint, row);       // TAUT_BODY_PART a group, then the vertices
READ(1, rvec4, before);   // xyz: displacement before the solve, m
READ(2, rvec4, delta);    // and after it
WRITE(3, real, sums);     // TAUT_MOMENTUM_SUMS a group
READ(4, rvec4, position); // m, w = inverse mass, 1/kg

SHARED(real, sum, 832);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = TAUT_BODY_PART * mine;
    uint rows = TAUT_BODY_PART * groups;
    uint last = row[own + 2u];
    PHASE_BEGIN
    rvec3 origin = rvec3(position[row[own]]);
    real weight = real(0);
    rvec3 lack = rvec3(real(0)), place = rvec3(real(0)), square = rvec3(real(0)), mixed = rvec3(real(0));
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[rows + j];
        rvec4 p = position[v];
        rvec3 d = rvec3(delta[v]);
        real mass = real(1) / p.w;
        rvec3 x = rvec3(p) - origin;
        rvec3 r = x + d;
        rvec3 moment = r * mass;
        weight += mass;
        lack += cross(x, rvec3(before[v]) - d) * mass;
        place += moment;
        square += moment * r;
        mixed += rvec3(r.y * moment.z, r.z * moment.x, r.x * moment.y);
    }
    uint at = TAUT_MOMENTUM_SUMS * lane;
    sum[at] = weight;
    for (int c = 0; c < 3; ++c)
    {
        sum[at + 1u + uint(c)] = lack[c];
        sum[at + 4u + uint(c)] = place[c];
        sum[at + 7u + uint(c)] = square[c];
        sum[at + 10u + uint(c)] = mixed[c];
    }
    PHASE_END
    SUM_BODY_LANES(TAUT_MOMENTUM_SUMS)
    LANES_BEGIN(TAUT_MOMENTUM_SUMS)
    if (group < groups)
        sums[TAUT_MOMENTUM_SUMS * mine + lane] = sum[lane];
    LANES_END
}
