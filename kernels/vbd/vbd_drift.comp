// How far the sweeps of a substep left each body that nothing holds from the momentum and the angular
// momentum that it must have: a group's share of the sums from which vbd_shift moves and turns it.
//
// Based on: Newton's third law: what acts between the vertices of a body changes neither, so the centre of
//   mass moves by the inertial guess y, and sum r x m (y - d) about it is zero where the substep ends, d
//   being the displacement. A few sweeps push with forces that are not opposite.
// Departures: none.
// Bytes per row: 8 + 48 read (float); contact 64 more.
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
    uint surfaces; // where in `contacts` they begin (vbd_touch)
    uint frame;    // as in vbd_rise
};

READ(0, uint, row);        // as in vbd_rise
READ(1, rvec4, predicted); // xyz: inertial guess of the displacement, m; w = inertia m / h^2, kg/s^2
READ(2, rvec4, delta);     // m
UPDATE(3, real, sums);     // TAUT_VBD_PARTS a group
READ(4, rvec4, position);  // m
#if CONTACT
READ(5, rvec4, push);     // m, what contacts added in the substep before (vbd_share)
READ(6, rvec4, contacts); // as vbd_solve leaves them
#include "shared/vbd_frame.glsl"
#endif

SHARED(real, sum, 1216);

/// Adds to the sums of a lane what is known of a vertex' momentum. r: its place from the body's first row.
void add_motion(uint v, rvec3 r, uint at)
{
    rvec4 y = predicted[v];
    rvec3 lack = rvec3(y - delta[v]);
    rvec3 turn = cross(r, lack);
    sum[at] += y.w;
    for (int c = 0; c < 3; ++c)
    {
        sum[at + TAUT_VBD_LACK + uint(c)] += lack[c] * y.w;
        sum[at + TAUT_VBD_PLACE + uint(c)] += r[c] * y.w;
        sum[at + TAUT_VBD_TURN + uint(c)] += turn[c] * y.w;
        sum[at + TAUT_VBD_SQUARE + uint(c)] += r[c] * r[c] * y.w;
    }
    sum[at + TAUT_VBD_MIXED] += r.y * r.z * y.w;
    sum[at + TAUT_VBD_MIXED + 1u] += r.z * r.x * y.w;
    sum[at + TAUT_VBD_MIXED + 2u] += r.x * r.y * y.w;
}

#if CONTACT
rvec4 contact_of(uint v, uint part) { return contacts[surfaces + TAUT_VBD_CONTACT * v + part]; }

/// What stops a vertex at a surface.
struct Foot
{
    rvec3 n;         // 0 where nothing does
    real size;       // of the push along n, N
    real friction;   // the most that it bears along the surface, N
    bool holds;      // which it does: the vertex does not slip
};

/// Of a way, what is along the surface and not its own.
rvec3 slip_of(uint v, rvec3 way, rvec3 n)
{
    rvec3 relative = way - rvec3(contact_of(v, TAUT_VBD_DRAG));
    return relative - n * dot(n, relative);
}

Foot foot_of(uint v)
{
    rvec4 plane = contact_of(v, TAUT_VBD_PLANE), drag = contact_of(v, TAUT_VBD_DRAG);
    rvec4 reaction = contact_of(v, TAUT_VBD_REACTION);
    rvec3 n = rvec3(plane);
    real pushed = dot(n, rvec3(reaction));
    // Of a stiff body sweeps may not reach the surface: then as if the vertex were alone.
    rvec3 guess = rvec3(predicted[v]);
    real depth = dot(n, n) > real(0) ? max(plane.w - dot(n, guess), real(0)) : real(0);
    bool alone = length(slip_of(v, guess, n)) <= drag.w * depth;
    Foot foot;
    foot.size = pushed > real(0) ? pushed : depth * predicted[v].w;
    foot.n = n * (foot.size > real(0) ? real(1) : real(0));
    foot.friction = drag.w * foot.size;
    foot.holds = pushed > real(0) ? reaction.w > real(0) : alone;
    return foot;
}

/// How a vertex stands, and where.
void add_foot(uint v, rvec3 r, uint at)
{
    Foot foot = foot_of(v);
    real counts = foot.size > real(0) ? real(1) : real(0);
    for (int c = 0; c < 3; ++c)
    {
        sum[at + TAUT_VBD_PUSHED + uint(c)] += push[v][c] * predicted[v].w;
        sum[at + TAUT_VBD_PUSH + uint(c)] += foot.n[c] * foot.size;
        sum[at + TAUT_VBD_FEET + uint(c)] += r[c] * counts;
        sum[at + TAUT_VBD_FEET_SQUARE + uint(c)] += r[c] * r[c] * counts;
    }
    sum[at + TAUT_VBD_SIZE] += foot.size;
    sum[at + TAUT_VBD_HOLD] += foot.holds ? foot.friction : real(0);
    sum[at + TAUT_VBD_COUNT] += counts;
    sum[at + TAUT_VBD_FEET_MIXED] += r.y * r.z * counts;
    sum[at + TAUT_VBD_FEET_MIXED + 1u] += r.z * r.x * counts;
    sum[at + TAUT_VBD_FEET_MIXED + 2u] += r.x * r.y * counts;
}

/// How it slips and rubs. at_frame: of what carries the body.
void add_rubbing(uint v, rvec3 r, uint at_frame, uint at)
{
    Foot foot = foot_of(v);
    rvec3 d = rvec3(delta[v]);
    rvec3 slip = slip_of(v, d, foot.n);
    // Where the sweeps stand still the guess knows which way the body goes.
    rvec3 wants = slip_of(v, rvec3(predicted[v]), foot.n);
    real size = length(wants);
    rvec3 rub = wants * (!foot.holds && size > real(0) ? foot.friction / size : real(0));
    rvec3 moved = d;
    if (is_carried(at_frame))
        moved -= carried_way(at_frame, r - d);
    rvec3 slip_turn = cross(r, slip), rub_turn = cross(r, rub), moved_turn = cross(r, moved);
    for (int c = 0; c < 3; ++c)
    {
        sum[at + TAUT_VBD_SLIP + uint(c)] += slip[c] * foot.size;
        sum[at + TAUT_VBD_SLIP_TURN + uint(c)] += slip_turn[c] * foot.size;
        sum[at + TAUT_VBD_RUB + uint(c)] += rub[c];
        sum[at + TAUT_VBD_RUB_TURN + uint(c)] += rub_turn[c];
        sum[at + TAUT_VBD_MOVED + uint(c)] += moved[c] * predicted[v].w;
        sum[at + TAUT_VBD_MOVED_TURN + uint(c)] += moved_turn[c] * predicted[v].w;
    }
    sum[at + TAUT_VBD_HEIGHT] += max(dot(foot.n, d) - contact_of(v, TAUT_VBD_PLANE).w, real(0)) * foot.size;
}
#endif

rvec3 from_first(uint v, uint base) { return rvec3(position[v] - position[base]) + rvec3(delta[v]); }

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
        add_motion(v, from_first(v, base), TAUT_VBD_DRIFT * lane);
    }
    PHASE_END
    SUM_BODY_LANES(TAUT_VBD_DRIFT)
    LANES_BEGIN(TAUT_VBD_DRIFT)
    if (group < groups)
        sums[TAUT_VBD_PARTS * mine + lane] = sum[lane];
    LANES_END
#if CONTACT
    PHASE_BEGIN
    CLEAR_BODY_SUM(TAUT_VBD_TOUCH)
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[words * row[rows + j]];
        add_foot(v, from_first(v, base), TAUT_VBD_TOUCH * lane);
    }
    PHASE_END
    SUM_BODY_LANES(TAUT_VBD_TOUCH)
    LANES_BEGIN(TAUT_VBD_TOUCH)
    if (group < groups)
        sums[TAUT_VBD_PARTS * mine + TAUT_VBD_DRIFT + lane] = sum[lane];
    LANES_END
    uint at_frame = frame + TAUT_VBD_FRAME * mine;
    PHASE_BEGIN
    CLEAR_BODY_SUM(TAUT_VBD_RUBBING)
    for (uint j = row[own + 1u] + lane; j < last; j += 64u)
    {
        uint v = row[words * row[rows + j]];
        add_rubbing(v, from_first(v, base), at_frame, TAUT_VBD_RUBBING * lane);
    }
    PHASE_END
    SUM_BODY_LANES(TAUT_VBD_RUBBING)
    LANES_BEGIN(TAUT_VBD_RUBBING)
    if (group < groups)
        sums[TAUT_VBD_PARTS * mine + TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + lane] = sum[lane];
    LANES_END
#endif
}
