// A plane between the two of each pair that parts them at the start of the substep, and how far each corner
// may go towards it. One invocation per pair.
//
//   room_k = s_k (n . x_k - p) - m,   s = 1 for corners of the first, -1 for those of the second,
//   m = 8 u (R + 4 (L + D)),
//
// R the greatest coordinate, L the size of the pair, D its greatest displacement, u the rounding unit. If
// every corner ends with s_k n . d_k >= -room_k, the pair is apart at both ends along one direction, hence
// all the way: ways are straight. p lies in the gap, nearer to the one that approaches less, so that standing
// still is allowed; held corners that move push it before them, and rooms become negative. Pairs nearer than
// 2 m stand still or part by m / 2 a corner; those that no direction parts stand still.
//
// Where all four, going all their way, end parted along n by 2 m, too, a plane may as well go with them, and
// nobody is asked to keep to the one that stands: what moves as one is not held up by itself.
//
// Based on: Chen et al. Divide and truncate, 2026, arXiv 2604.15513 (planes between the two of a pair, each
//   vertex held by its own), through the codes that follow it.
// Departures: directions are certified by all four corners; rounding has a margin; planes may move with what
//   is held.
// Bytes per pair: 20 + 48 a corner read, 32 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/closest.glsl"
#include "shared/guarantee.glsl"

PARAMS
{
    uint capacity;
};

READ(0, ContactPair, pair);
READ(1, rvec4, position); // w = inverse mass; 0 is held
READ(2, rvec4, low);
READ(3, rvec4, delta); // m, as the substep would end
READ(4, uint, control);
WRITE(5, rvec4, row); // two a pair: n, w = m, of edges -m; rooms, m, 1e30 of held corners
COUNTERS(6, lost);
COUNTERS(7, asked); // corners that have to keep to their planes

/// The plane's height after `held` corners of the first (least) and the second (most) have pushed it.
INLINE real pushed(real plane, real first, real second, real margin)
{
    return min(max(plane, second + margin), first - margin);
}

/// The way between the nearest points, else the widest of the other directions.
INLINE Separator widest_of(rbool edges, rvec3 e1, rvec3 e2, rvec3 e3, real enough)
{
    rvec3 way = closest_of_pair(edges, e1, e2, e3).way;
    Separator best = separator_along(way, e1, e2, e3, edges);
    rbool narrow = best.gap <= enough;
    if (ANY(narrow && edges))
    {
        Separator other = separator_of_edges(way, e1, e2, e3);
        best = separator_of_two(narrow && edges && other.gap > best.gap, best, other);
    }
    if (ANY(narrow && !edges))
    {
        Separator other = separator_of_vertex(way, e1, e2, e3);
        best = separator_of_two(narrow && !edges && other.gap > best.gap, best, other);
    }
    return best;
}

KERNEL(min(capacity, control[TAUT_CONTACT_LISTED]))
{
    ContactPair p = pair[i];
    rbool edges = p.kind == TAUT_CONTACT_EDGES;
    rvec4 x0 = position[p.a];
    rvec4 x1 = position[p.b];
    rvec4 x2 = position[p.c];
    rvec4 x3 = position[p.d];
    rvec4 l0 = low[p.a];
    rvec4 l1 = low[p.b];
    rvec4 l2 = low[p.c];
    rvec4 l3 = low[p.d];
    rvec3 d0 = rvec3(delta[p.a] - l0);
    rvec3 d1 = rvec3(delta[p.b] - l1);
    rvec3 d2 = rvec3(delta[p.c] - l2);
    rvec3 d3 = rvec3(delta[p.d] - l3);
    rvec3 e1 = rvec3((x1 - x0) + (l1 - l0));
    rvec3 e2 = rvec3((x2 - x0) + (l2 - l0));
    rvec3 e3 = rvec3((x3 - x0) + (l3 - l0));
    rbool free0 = x0.w > real(0);
    rbool free1 = x1.w > real(0);
    rbool free2 = x2.w > real(0);
    rbool free3 = x3.w > real(0);
    real far = max(max(greatest_of(rvec3(x0)), greatest_of(rvec3(x1))),
                   max(greatest_of(rvec3(x2)), greatest_of(rvec3(x3))));
    real size = max(greatest_of(e1), max(greatest_of(e2), greatest_of(e3)));
    real motion = max(max(greatest_of(d0), greatest_of(d1)), max(greatest_of(d2), greatest_of(d3)));
    real m = real(8) * rounding_unit() * (far + real(4) * (size + motion));
    Separator s = widest_of(edges, e1, e2, e3, real(2) * m);
    rvec3 n = s.normal;
    real ahead0 = dot(n, d0);
    real ahead1 = dot(n, d1);
    real ahead2 = dot(n, d2);
    real ahead3 = dot(n, d3);
    // How much each of the two comes nearer.
    real first = max(real(0), -SELECT(edges, min(ahead0, ahead1), ahead0));
    real second = max(real(0), max(max(ahead2, ahead3), SELECT(edges, real(0), ahead1)));
    real sum = first + second;
    rbool meet = sum > real(0);
    real of_second = second / SELECT(meet, sum, real(1));
    real share = SELECT(meet, min(max(of_second, REAL(0.05)), REAL(0.95)), real(0.5));
    rbool tight = s.gap <= real(2) * m;
    rbool apart = s.gap > REAL(0.75) * m;
    real plane = SELECT(tight, real(0.5) * (s.low + s.high), (s.high + m) + share * (s.gap - real(2) * m));
    // Where held corners end.
    real end1 = s.height_b + ahead1;
    real end2 = s.height_c + ahead2;
    real end3 = s.height_d + ahead3;
    real none = REAL(1e30);
    real held_first = SELECT(free0, none, ahead0);
    real held_second = max(SELECT(free2, -none, end2), SELECT(free3, -none, end3));
    held_first = SELECT(edges && !free1, min(held_first, end1), held_first);
    held_second = SELECT(edges || free1, held_second, max(held_second, end1));
    real keep = SELECT(tight, real(0), m);
    rbool clear = held_second + keep <= plane && held_first - keep >= plane;
    real now = SELECT(clear, plane, pushed(plane, held_first, held_second, m));
    real side = SELECT(edges, real(1), real(-1)); // of corner b
    rbool parts = tight && clear;
    real parting = real(-0.5) * m;
    real room0 = SELECT(parts, parting, -now - m);
    real room1 = SELECT(parts, parting, side * (s.height_b - now) - m);
    real room2 = SELECT(parts, parting, (now - s.height_c) - m);
    real room3 = SELECT(parts, parting, (now - s.height_d) - m);
    row[2u * i] = rvec4(n, SELECT(edges, -m, m));
    row[2u * i + 1u] = rvec4(SELECT(free0, SELECT(apart, room0, -none), none),
                             SELECT(free1, SELECT(apart, room1, -none), none),
                             SELECT(free2, SELECT(apart, room2, -none), none),
                             SELECT(free3, SELECT(apart, room3, -none), none));
    real end_low = SELECT(edges, min(ahead0, end1), ahead0);
    real end_high = SELECT(edges, max(end2, end3), max(end1, max(end2, end3)));
    rbool asks = !apart || end_low - end_high <= real(2) * m;
    COUNT_EVENT_IF(asks, asked, p.a);
    COUNT_EVENT_IF(asks, asked, p.b);
    COUNT_EVENT_IF(asks, asked, p.c);
    COUNT_EVENT_IF(asks, asked, p.d);
    // Nothing keeps out of the way of a held corner where no direction parts the pair.
    real led = max(max(SELECT(free0, real(0), greatest_of(d0)), SELECT(free1, real(0), greatest_of(d1))),
                   max(SELECT(free2, real(0), greatest_of(d2)), SELECT(free3, real(0), greatest_of(d3))));
    rbool pinched = held_second + keep > held_first - keep || (!apart && led > real(0));
    COUNT_EVENT_IF(asks && pinched, lost, TAUT_CONTACT_PINCHED);
}
