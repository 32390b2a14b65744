// How far the sweeps of a substep left each body that nothing holds from the momentum and the angular
// momentum that it must have: a group's share of the sums from which vbd_shift moves and turns it.
//
// Based on: Newton's third law: what acts between the vertices of a body changes neither, so the centre of
//   mass moves by the inertial guess y, and sum r x m (y - d) about it is zero where the substep ends, d
//   being the displacement. A few sweeps push with forces that are not opposite.
// Departures: none.
// Bytes per row: 8 + 48 read (float); contact 16 more.
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint words; // of a row
};

READ(0, uint, row);        // as in vbd_rise
READ(1, rvec4, predicted); // xyz: inertial guess of the displacement, m; w = inertia m / h^2, kg/s^2
READ(2, rvec4, delta);     // m
WRITE(3, real, sums);      // TAUT_VBD_DRIFT a group
READ(4, rvec4, position);  // m
#if CONTACT
READ(5, rvec4, push); // m, what contacts added in the substep before (vbd_share)
#endif

SHARED(real, sum, 1216);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint last = row[own + 5u] != 0u ? 0u : row[own + 2u];
    uint base = row[words * row[own]];
    PHASE_BEGIN
    for (uint k = 0u; k < TAUT_VBD_DRIFT; ++k)
        sum[TAUT_VBD_DRIFT * lane + k] = real(0);
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[words * row[rows + j]];
        rvec4 y = predicted[v];
        rvec3 lack = rvec3(y - delta[v]);
        rvec3 r = rvec3(position[v] - position[base]) + rvec3(delta[v]);
        rvec3 turn = cross(r, lack);
        uint at = TAUT_VBD_DRIFT * lane;
        sum[at] += y.w;
        for (int c = 0; c < 3; ++c)
        {
            sum[at + 1u + uint(c)] += lack[c] * y.w;
            sum[at + 4u + uint(c)] += r[c] * y.w;
            sum[at + 7u + uint(c)] += turn[c] * y.w;
            sum[at + 10u + uint(c)] += r[c] * r[c] * y.w;
        }
#if CONTACT
        for (int c = 0; c < 3; ++c)
            sum[at + 16u + uint(c)] += push[v][c] * y.w;
#endif
        sum[at + 13u] += r.y * r.z * y.w;
        sum[at + 14u] += r.z * r.x * y.w;
        sum[at + 15u] += r.x * r.y * y.w;
    }
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        for (uint k = 0u; k < TAUT_VBD_DRIFT; ++k)
            sum[TAUT_VBD_DRIFT * lane + k] += sum[TAUT_VBD_DRIFT * (lane + width) + k];
        LANES_END
    }
    LANES_BEGIN(TAUT_VBD_DRIFT)
    if (group < groups)
        sums[TAUT_VBD_DRIFT * mine + lane] = sum[lane];
    LANES_END
}
