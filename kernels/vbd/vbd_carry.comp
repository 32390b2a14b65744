// How the surfaces move that the guess of a body goes below: a group's share of the sums from which vbd_frame
// finds a rigid motion.
//
// Based on: no paper; energies of a body that is carried are those seen from what carries it, else they would
//   depend on who looks (docs/methods/vbd.md).
// Departures: none.
// Bytes per row: 8 + 64 read (float).
#include "shared/portable.glsl"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/vbd_parts.h"

PARAMS
{
    uint groups;
    uint table;    // as in vbd_rise
    uint words;    // of a row
    uint surfaces; // where in `contacts` they begin (vbd_touch)
    uint carry;    // where in `sums` to write
};

READ(0, uint, row);       // as in vbd_rise
READ(1, rvec4, position); // m
READ(2, rvec4, predicted); // the inertial guess, m
READ(3, rvec4, contacts); // of vbd_touch
UPDATE(4, real, sums);    // TAUT_VBD_DRIFT a group

SHARED(real, sum, 1024);

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint last = row[own + 5u] != 0u ? 0u : row[own + 2u];
    uint base = row[words * row[own]];
    PHASE_BEGIN
    CLEAR_BODY_SUM(TAUT_VBD_DRIFT)
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[words * row[rows + j]];
        rvec4 plane = contacts[surfaces + TAUT_VBD_CONTACT * v + TAUT_VBD_PLANE];
        rvec3 way = rvec3(contacts[surfaces + TAUT_VBD_CONTACT * v + TAUT_VBD_DRAG]);
        rvec3 r = rvec3(position[v] - position[base]);
        real depth = max(plane.w - dot(rvec3(plane), rvec3(predicted[v])), real(0));
        rvec3 turn = cross(r, way);
        uint at = TAUT_VBD_DRIFT * lane;
        sum[at] += depth;
        for (int c = 0; c < 3; ++c)
        {
            sum[at + TAUT_VBD_LACK + uint(c)] += way[c] * depth;
            sum[at + TAUT_VBD_PLACE + uint(c)] += r[c] * depth;
            sum[at + TAUT_VBD_TURN + uint(c)] += turn[c] * depth;
            sum[at + TAUT_VBD_SQUARE + uint(c)] += r[c] * r[c] * depth;
        }
        sum[at + TAUT_VBD_MIXED] += r.y * r.z * depth;
        sum[at + TAUT_VBD_MIXED + 1u] += r.z * r.x * depth;
        sum[at + TAUT_VBD_MIXED + 2u] += r.x * r.y * depth;
    }
    PHASE_END
    SUM_BODY_LANES(TAUT_VBD_DRIFT)
    LANES_BEGIN(TAUT_VBD_DRIFT)
    if (group < groups)
        sums[carry + TAUT_VBD_DRIFT * mine + lane] = sum[lane];
    LANES_END
}
