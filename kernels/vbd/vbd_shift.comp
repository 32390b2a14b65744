// Gives each body that nothing holds the momentum that it must have after the sweeps (vbd_drift), by moving
// it as a whole: no element changes its shape, and of all such moves this one lowers the incremental
// potential most. One group per part of a body; every group of a body adds up the sums alike.
//
// Based on: Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM
//   1987: an error along known directions is taken out exactly (here the translations of a body).
// Departures: with CONTACT a body that touched a collider in the substep before is moved across gravity only:
//   what carries it is not in the sweeps, and the adaptive start has its share of gravity from there.
// Bytes per row: 8 + 16 read, 16 written (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint words; // of a row
};

READ(0, uint, row);      // as in vbd_rise
READ(1, real, sums);     // of vbd_drift
UPDATE(2, rvec4, delta); // m
#if CONTACT
READ(3, uint, seen); // as in vbd_start
READ_ONE(4, StepValues, step_values);
#endif

SHARED(real, sum, 256);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_VBD_PART * mine;
    uint rows = table + TAUT_VBD_PART * groups;
    uint from = row[own + 3u];
    PHASE_BEGIN
    for (uint k = 0u; k < 4u; ++k)
        sum[4u * lane + k] = real(0);
    for (uint j = from + lane; j < row[own + 4u]; j += 64u)
        for (uint k = 0u; k < 4u; ++k)
            sum[4u * lane + k] += sums[4u * j + k];
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        for (uint k = 0u; k < 4u; ++k)
            sum[4u * lane + k] += sum[4u * (lane + width) + k];
        LANES_END
    }
    rvec3 way = rvec3(sum[0], sum[1], sum[2]) / sum[3];
#if CONTACT
    rvec3 gravity = rvec3(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z);
    real pull = dot(gravity, gravity);
    uint base = row[words * row[own]];
    bool touches = seen[2u * base + 1u] != 0u;
    way -= touches && pull > real(0) ? gravity * (dot(way, gravity) / pull) : rvec3(real(0));
#endif
    bool moves = group < groups && row[own + 5u] == 0u && abs(way.x) + abs(way.y) + abs(way.z) < REAL(1e18);
    uint last = moves ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[words * row[rows + uint(i)]];
    delta[v] = delta[v] + rvec4(way, real(0));
    EACH_END
}
