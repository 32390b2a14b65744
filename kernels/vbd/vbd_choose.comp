// Takes the fallback of vbd_rise in bodies whose start raises the incremental potential against it. One group
// per part of a body; every group of a body adds up the sums alike.
//
// Based on: no paper; a sweep only lowers the potential, so the end of the sweeps is below the fallback if
//   the start is (docs/methods/vbd.md).
// Departures: none.
// Bytes per row: 12 read; 32 more read and 16 written where the start is not taken, and contact 16 more read
//   (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table; // as in vbd_rise
    uint words; // of a row
    uint frame; // as in vbd_rise; of the variant contact there is one
};

READ(0, uint, row);      // as in vbd_rise
READ(1, rvec4, low);     // m
UPDATE(2, real, sums);   // of vbd_rise; the way of gravity
UPDATE(3, rvec4, delta); // m
READ_ONE(4, StepValues, step_values);
#if CONTACT
READ(5, rvec4, position); // m
#include "shared/vbd_frame.glsl"
#endif

SHARED(real, sum, 640);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint from = row[own + 3u];
    SUM_BODY_PARTS(10u, sums, 0u, TAUT_VBD_SUMS, from, row[own + 4u])
    bool held = row[own + 5u] != 0u;
    rvec3 mean = rvec3(sum[2], sum[3], sum[4]) / sum[1];
    rvec3 guess = rvec3(sum[5], sum[6], sum[7]);
    real rise = held ? sum[0] : sum[0] + (dot(mean, guess) - (real(0.5) * sum[1]) * dot(mean, mean));
    uint at = TAUT_VBD_SUMS * mine + 10u;
    rvec3 way = mean + rvec3(sums[at], sums[at + 1u], sums[at + 2u]);
#if CONTACT
    uint at_frame = frame + TAUT_VBD_FRAME * mine;
    bool carried = !held && is_carried(at_frame);
    rise = carried ? sum[0] : rise;
#endif
    uint last = group < groups && (rise > real(0) || !IS_FINITE(rise)) ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[words * row[rows + uint(i)]];
    rvec4 d = delta[v];
    rvec3 still = held ? rvec3(real(0)) : way;
#if CONTACT
    if (carried)
        still = carried_way(at_frame, rvec3(position[v] - position[row[words * row[own]]]));
#endif
    delta[v] = rvec4(rvec3(low[v]) + still, d.w);
    EACH_END
    LANES_BEGIN(1)
    if (group == 0u)
    {
        uint end = TAUT_VBD_PARTS * groups;
        real square = step_values[0].substep * step_values[0].substep;
        sums[end] = step_values[0].gravity_x * square;
        sums[end + 1u] = step_values[0].gravity_y * square;
        sums[end + 2u] = step_values[0].gravity_z * square;
    }
    LANES_END
}
