// How far the sweeps of a substep left each body that nothing holds from its momentum: a group's share of the
// sums from which vbd_shift moves it.
//
// Based on: Newton's third law: what acts between the vertices of a body changes nothing of its momentum, so
//   its centre of mass moves by the inertial guess. A few sweeps push with forces that are not opposite.
// Departures: none.
// Bytes per row: 8 + 48 read (float).
#include "shared/portable.glsl"
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
WRITE(3, real, sums);      // four a group: inertia times what lacks, and inertia

SHARED(real, sum, 256);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_VBD_PART * mine;
    uint rows = table + TAUT_VBD_PART * groups;
    uint last = row[own + 5u] != 0u ? 0u : row[own + 2u];
    PHASE_BEGIN
    rvec3 lack = rvec3(real(0));
    real inertia = real(0);
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[words * row[rows + j]];
        rvec4 y = predicted[v];
        lack += rvec3(y - delta[v]) * y.w;
        inertia += y.w;
    }
    sum[4u * lane] = lack.x;
    sum[4u * lane + 1u] = lack.y;
    sum[4u * lane + 2u] = lack.z;
    sum[4u * lane + 3u] = inertia;
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        for (uint k = 0u; k < 4u; ++k)
            sum[4u * lane + k] += sum[4u * (lane + width) + k];
        LANES_END
    }
    LANES_BEGIN(4)
    if (group < groups)
        sums[4u * mine + lane] = sum[lane];
    LANES_END
}
