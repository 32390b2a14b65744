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

/// The way of a corner in the substep; w as of the position.
INLINE rvec4 way_of(uint v)
{
    return rvec4(rvec3(delta[v]) - rvec3(low[v]), position[v].w);
}

/// From corner a to corner b.
INLINE rvec3 between_corners(uint a, uint b)
{
    return (rvec3(position[b]) - rvec3(position[a])) + (rvec3(low[b]) - rvec3(low[a]));
}

/// The plane's height after `held` corners of the first (least) and the second (most) have pushed it.
INLINE real pushed(real plane, real first, real second, real margin)
{
    return min(max(plane, second + margin), first - margin);
}

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        bool edges = p.kind == TAUT_CONTACT_EDGES;
        rvec3 e1 = between_corners(p.a, p.b);
        rvec3 e2 = between_corners(p.a, p.c);
        rvec3 e3 = between_corners(p.a, p.d);
        rvec4 d0 = way_of(p.a);
        rvec4 d1 = way_of(p.b);
        rvec4 d2 = way_of(p.c);
        rvec4 d3 = way_of(p.d);
        real far = max(max(greatest_of(rvec3(position[p.a])), greatest_of(rvec3(position[p.b]))),
                       max(greatest_of(rvec3(position[p.c])), greatest_of(rvec3(position[p.d]))));
        real size = max(greatest_of(e1), max(greatest_of(e2), greatest_of(e3)));
        real motion = max(max(greatest_of(rvec3(d0)), greatest_of(rvec3(d1))),
                          max(greatest_of(rvec3(d2)), greatest_of(rvec3(d3))));
        real m = real(8) * rounding_unit() * (far + real(4) * (size + motion));
        Closest near = closest_vertex_triangle(e1, e2, e3);
        if (edges)
            near = closest_edges(e1, e2, e3);
        Separator s = separator_along(near.way, e1, e2, e3, edges);
        if (!(s.gap > real(2) * m) && edges)
            s = wider_of(s, separator_of_edges(near.way, e1, e2, e3));
        if (!(s.gap > real(2) * m) && !edges)
            s = wider_of(s, separator_of_vertex(near.way, e1, e2, e3));
        rvec3 n = s.normal;
        rvec4 ahead = rvec4(dot(n, rvec3(d0)), dot(n, rvec3(d1)), dot(n, rvec3(d2)), dot(n, rvec3(d3)));
        // How much each of the two comes nearer.
        real first = max(real(0), -(edges ? min(ahead.x, ahead.y) : ahead.x));
        real second = max(real(0), max(max(ahead.z, ahead.w), edges ? real(0) : ahead.y));
        real sum = first + second;
        real share = sum > real(0) ? min(max(second / sum, REAL(0.05)), REAL(0.95)) : real(0.5);
        bool tight = !(s.gap > real(2) * m);
        bool apart = s.gap > REAL(0.75) * m;
        real plane = tight ? real(0.5) * (s.low + s.high)
                           : (s.high + m) + share * (s.gap - real(2) * m);
        // Where held corners end.
        rvec4 end = s.height + ahead;
        real none = REAL(1e30);
        real held_first = d0.w > real(0) ? none : end.x;
        real held_second = max(d2.w > real(0) ? -none : end.z, d3.w > real(0) ? -none : end.w);
        if (d1.w == real(0))
        {
            held_first = edges ? min(held_first, end.y) : held_first;
            held_second = edges ? held_second : max(held_second, end.y);
        }
        real keep = tight ? real(0) : m;
        bool clear = held_second + keep <= plane && held_first - keep >= plane;
        real now = clear ? plane : pushed(plane, held_first, held_second, m);
        rvec4 side = rvec4(real(1), edges ? real(1) : real(-1), real(-1), real(-1));
        rvec4 room = side * (s.height - rvec4(now)) - rvec4(m);
        room = tight && clear ? rvec4(real(-0.5) * m) : room;
        room = apart ? room : rvec4(-none);
        row[2u * i] = rvec4(n, edges ? -m : m);
        row[2u * i + 1u] = rvec4(d0.w > real(0) ? room.x : none, d1.w > real(0) ? room.y : none,
                                 d2.w > real(0) ? room.z : none, d3.w > real(0) ? room.w : none);
        real end_low = edges ? min(end.x, end.y) : end.x;
        real end_high = edges ? max(end.z, end.w) : max(end.y, max(end.z, end.w));
        bool asks = !(apart && end_low - end_high > real(2) * m);
        COUNT_EVENT_IF(asks, asked, p.a);
        COUNT_EVENT_IF(asks, asked, p.b);
        COUNT_EVENT_IF(asks, asked, p.c);
        COUNT_EVENT_IF(asks, asked, p.d);
        COUNT_EVENT_IF(asks && held_second + keep > held_first - keep, lost, TAUT_CONTACT_PINCHED);
    }
}
