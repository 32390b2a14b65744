// By how much the displacements of a body raise its energy against a fallback: a group's share of the sums
// from which vbd_choose decides of the start of the sweeps, and vbd_limit of their end. In the fallback a
// body moves as one: not at all where something of it is held, with what carries it where something does
// (vbd_frame), else by the mean of its displacements. It changes the shape of no element between vertices
// that move.
//
// Based on: Martin et al. Example-Based Elastic Materials. SIGGRAPH 2011, eq. 2 (the potential).
// Departures: differences are formed element by element (shared/rise.glsl); displacements are taken against
//   that of one vertex of the body, so that the common way of a body that flies does not swallow the digits.
// Bytes per row: 4 + 16 + 64 read; per spring 24 + 48 (damped 80), per hinge 24 + 192, per held volume
//   24 + 192, per elastic tetrahedron 72 + 192 (float), each once for every vertex of it that moves.
//! variant hinges HINGES=1
//! variant volumes HINGES=1 VOLUMES=1
//! variant elastic HINGES=1 ELASTIC=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/body_parts.h"
#include "shared/body_sums.glsl"
#include "shared/vbd_parts.h"
#if HINGES
#include "shared/hinge.glsl"
#endif
#if ELASTIC
#include "shared/solid.glsl"
#endif
#include "shared/rise.glsl"

PARAMS
{
    uint groups;
    uint ended; // 0: of the start, by the incremental potential; 1: after the sweeps, by kinetic energy
    uint table; // where in `row` the groups stand: TAUT_BODY_PART words each, behind the last one their rows
    uint frame; // where in `sums` the frames of vbd_frame are; 0 = none
};

READ(0, uint, row);        // as in vbd_solve
READ(1, Spring, end);      // as in vbd_solve
READ(2, rvec4, position);  // xyz m, w = inverse mass 1/kg
READ(3, rvec4, low);       // m; the displacement of a vertex that stands still
READ(4, rvec4, predicted); // xyz: inertial guess of the displacement, m; w = inertia m / h^2, kg/s^2
READ(5, rvec4, delta);     // m
UPDATE(6, real, sums);     // TAUT_VBD_SUMS a group, and TAUT_VBD_FALL
#if HINGES
#if ELASTIC
READ(7, SolidTetrahedron, corner); // as in vbd_solve
#else
READ(7, BendingConstraint, corner);
#endif
#endif
#include "shared/vbd_rows.glsl"
#include "shared/vbd_frame.glsl"

SHARED(real, sum, 640);

/// Where a vertex stands in the fallback, but for what moves all of the body alike.
rvec3 still(uint v, bool moves) { return rvec3(moves ? low[v] : delta[v]); }

/// From one vertex to another: in the fallback, and how that changes at the start.
struct Edge
{
    rvec3 before, change;
};

Edge edge_of(uint from, uint to)
{
    rvec4 a = position[from];
    rvec4 b = position[to];
    rvec3 a_still = still(from, a.w > real(0));
    rvec3 b_still = still(to, b.w > real(0));
    Edge edge;
    edge.before = rvec3(b - a) + (b_still - a_still);
    edge.change = (rvec3(delta[to]) - b_still) - (rvec3(delta[from]) - a_still);
    return edge;
}

/// By how much a spring is longer in the fallback than before the substep: held ends move in both.
real longer_before(Spring s, Edge e, uint v)
{
    rvec3 ends = still(v, position[v].w > real(0)) - still(s.b, position[s.b].w > real(0));
    rvec3 came = ends - (rvec3(low[v]) - rvec3(low[s.b]));
    rvec3 first = e.before - came;
    return lengthening(first, came, length(first) + length(e.before), real(1));
}

/// The potential of a damper is c/2 (length - first length)^2 / h, as in vbd_solve.
real springs_rise(uint k, uint v, real inverse_substep)
{
    real rise = real(0);
    for (uint j = row_word(k, 1u); j < row_word(k + 1u, 1u); ++j)
    {
        Spring s = end[j];
        if (!leads(v, s.b, position[s.b].w))
            continue;
        Edge e = edge_of(s.b, v);
        real both = length(e.before) + length(e.before + e.change);
        real longer = lengthening(e.before, e.change, both, real(1));
        real stretch = (both - s.rest_length) - s.rest_length;
        real both_longer = longer;
        if (s.damping > real(0))
            both_longer += real(2) * longer_before(s, e, v);
        rise += real(0.5) * (longer * (s.stiffness * stretch + (s.damping * inverse_substep) * both_longer));
    }
    return rise;
}

#if HINGES
HingeShape shape_of(Edge e, Edge a, Edge b, real share)
{
    return hinge_shape(e.before + e.change * share, a.before + a.change * share, b.before + b.change * share);
}

real hinges_rise(uint k, uint v)
{
    real rise = real(0);
    for (uint j = row_word(k, 2u); j < row_word(k + 1u, 2u); ++j)
    {
        BendingConstraint c = hinge_at(j);
        if (!counts_for(v, c))
            continue;
        Edge e = edge_of(c.edge0, c.edge1);
        Edge a = edge_of(c.edge0, c.wing0);
        Edge b = edge_of(c.edge0, c.wing1);
        HingeShape now = shape_of(e, a, b, real(0));
        HingeShape then = shape_of(e, a, b, real(1));
        real turn = angle_difference(then.angle, now.angle);
        real both = real(2) * angle_difference(now.angle, c.rest_angle) + turn;
        rise += now.shaped && then.shaped ? real(0.5) * ((turn / c.compliance) * both) : real(0);
    }
    return rise;
}
#endif

#if VOLUMES || ELASTIC
real tetrahedra_rise(uint k, uint v)
{
    real rise = real(0);
    for (uint j = row_word(k, 4u); j < row_word(k + 1u, 4u); ++j)
    {
#if ELASTIC
        SolidTetrahedron t = corner[j];
        uint v0 = t.a, v2 = t.c, v3 = t.d;
#else
        BendingConstraint t = corner[j];
        uint v0 = t.edge0, v2 = t.wing0, v3 = t.wing1;
#endif
        if (!(leads(v, v0, position[v0].w) && leads(v, v2, position[v2].w) && leads(v, v3, position[v3].w)))
            continue;
        Edge e1 = edge_of(v0, v);
        Edge e2 = edge_of(v0, v2);
        Edge e3 = edge_of(v0, v3);
#if ELASTIC
        if (t.mu <= real(0)) // a held volume: its edges are in cubes of metres, not stretches
        {
#endif
            real size = real(1) / real(6);
            real now = dot(e1.before, cross(e2.before, e3.before)) * size;
            real more = (dot(e1.change, cross(e2.before + e2.change, e3.before + e3.change)) +
                         dot(e1.before, cross(e2.change, e3.before + e3.change))) +
                        dot(e1.before, cross(e2.before, e3.change));
            more *= size;
#if ELASTIC
            real away = now - t.rest * t.volume;
            rise += (t.lambda / t.volume) * (more * (away + real(0.5) * more));
        }
        else
        {
            Deformation f = deformation_of(t, e1.before, e2.before, e3.before);
            rise += t.volume * solid_rise(t, f, e1.change, e2.change, e3.change, real(1));
        }
#else
            rise += (more / t.compliance) * ((now - t.rest_angle) + real(0.5) * more);
#endif
    }
    return rise;
}
#endif

real elements_rise(uint k, uint v, real inverse_substep)
{
    real rise = springs_rise(k, v, inverse_substep);
#if HINGES
    rise += hinges_rise(k, v);
#endif
#if VOLUMES || ELASTIC
    rise += tetrahedra_rise(k, v);
#endif
    return rise;
}

/// Adds to the ten sums of a lane what a row brings. first: the row that the body's groups share; at_frame:
/// the frame of what carries the body, 0 = nothing does.
void add_row(uint k, uint first, uint lane, bool held, uint at_frame)
{
    uint v = row_word(k, 0u);
    rvec4 y = predicted[v];
    rvec3 fall = rvec3(real(0));
    if (ended != 0u)
        fall = rvec3(sums[TAUT_VBD_PARTS * groups], sums[TAUT_VBD_PARTS * groups + 1u],
                     sums[TAUT_VBD_PARTS * groups + 2u]);
    rvec3 frame_way = rvec3(real(0));
    if (at_frame != 0u)
        frame_way = carried_way(at_frame, rvec3(position[v] - position[first]));
    rvec3 way = rvec3(delta[v] - low[v]) - frame_way;
    rvec3 came = (rvec3(y - low[v]) - fall) - frame_way;
    bool seen_from_rest = held || at_frame != 0u;
    rvec3 moved = way;
    rvec3 guess = came;
    if (!seen_from_rest)
    {
        moved -= rvec3(delta[first] - low[first]);
        guess -= ended != 0u ? rvec3(predicted[first] - low[first]) - fall : rvec3(delta[first] - low[first]);
    }
    real work = seen_from_rest ? dot(fall, way) : real(0);
    real own = ended != 0u ? -work : real(0.5) * dot(moved, rvec3(delta[v] - y) - guess);
    uint at = 10u * lane;
    sum[at] += y.w * own + elements_rise(k, v, sqrt(y.w * position[v].w));
    sum[at + 1u] += y.w;
    sum[at + 2u] += y.w * moved.x;
    sum[at + 3u] += y.w * moved.y;
    sum[at + 4u] += y.w * moved.z;
    sum[at + 5u] += y.w * guess.x;
    sum[at + 6u] += y.w * guess.y;
    sum[at + 7u] += y.w * guess.z;
    sum[at + 8u] += y.w * dot(moved, moved);
    sum[at + 9u] += y.w * dot(guess, guess);
}

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    uint own = table + TAUT_BODY_PART * mine;
    uint rows = table + TAUT_BODY_PART * groups;
    uint first = row_word(row[own], 0u);
    uint at_frame = 0u;
    if (frame != 0u)
        at_frame = is_carried(frame + TAUT_VBD_FRAME * mine) ? frame + TAUT_VBD_FRAME * mine : 0u;
    PHASE_BEGIN
    CLEAR_BODY_SUM(10u)
    for (uint j = row[own + 1u] + lane; j < row[own + 2u]; j += 64u)
        add_row(row[rows + j], first, lane, row[own + 5u] != 0u, at_frame);
    PHASE_END
    SUM_BODY_LANES(10u)
    LANES_BEGIN(1)
    if (group < groups)
    {
        uint at = TAUT_VBD_SUMS * mine;
        rvec3 origin = rvec3(delta[first] - low[first]);
        for (uint k = 0u; k < 10u; ++k)
            sums[at + k] = sum[k];
        sums[at + 10u] = origin.x;
        sums[at + 11u] = origin.y;
        sums[at + 12u] = origin.z;
    }
    LANES_END
}
