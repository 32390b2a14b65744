// Shortens what the sweeps of a substep did to a body where it would make energy: its displacements are
// brought towards the fallback of vbd_rise, by as much as takes the surplus away. With A the kinetic energy
// at the start and R what the fallback has less of kinetic and elastic energy than the end, after the work
// of gravity, an energy that is convex on the way is at most s R - A above that at the start when a share s
// of the way is taken; so s = (A + B) / R where R > A + B. B is what the substeps before lost, but no more
// than A: sweeps that are not at their end store in one substep what the next ones give back. Below 0 it is
// owed (vbd_shift). One group per part of a body; every group of a body adds up the sums alike, and keeps B
// alike.
//
// Based on: Dinev et al. Stabilizing Integrators for Real-Time Physics. ACM TOG 37(1), 2018: energy is
//   brought back to what it was by blending two states.
// Departures: it is only kept from rising; for each body alone; the state to blend with is one that no
//   element feels. Kinetic energy of what nothing holds is that about its mean, whose motion vbd_shift sets.
// Bytes per row: 12 read; 32 more read and 16 written where it acts, and contact 16 more read (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
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
READ(2, real, sums);     // of vbd_rise
UPDATE(3, rvec4, delta); // m
UPDATE(4, real, lost);   // by group, J: B
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
#if CONTACT
    uint at_frame = frame + TAUT_VBD_FRAME * mine;
    bool carried = !held && is_carried(at_frame);
    held = held || carried;
#endif
    rvec3 mean = rvec3(sum[2], sum[3], sum[4]) / sum[1];
    rvec3 came = rvec3(sum[5], sum[6], sum[7]) / sum[1];
    mean = held ? rvec3(real(0)) : mean;
    came = held ? rvec3(real(0)) : came;
    real had = real(0.5) * max(sum[9] - sum[1] * dot(came, came), real(0));
    real has = sum[0] + real(0.5) * max(sum[8] - sum[1] * dot(mean, mean), real(0));
    real spare = clamp(lost[mine], -had, had);
    real most = had + spare;
    real share = has > most ? most / has : real(1);
    uint at = TAUT_VBD_SUMS * mine + 10u;
    rvec3 way = held ? rvec3(real(0)) : mean + rvec3(sums[at], sums[at + 1u], sums[at + 2u]);
    uint last = group < groups && share < real(1) ? row[own + 2u] : 0u;
    EACH_BEGIN(row[own + 1u], last)
    uint v = row[words * row[rows + uint(i)]];
    rvec4 d = delta[v];
    rvec3 still = rvec3(low[v]) + way;
#if CONTACT
    if (carried)
        still += carried_way(at_frame, rvec3(position[v] - position[row[words * row[own]]]));
#endif
    delta[v] = rvec4(still + (rvec3(d) - still) * share, d.w);
    EACH_END
    LANES_BEGIN(1)
    if (group < groups)
        lost[mine] = min(spare - min(has - had, spare), had);
    LANES_END
}
