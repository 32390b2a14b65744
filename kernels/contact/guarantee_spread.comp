// Who has to keep to its planes because a neighbour does. Where all four corners of a pair go all their way,
// or all keep to its plane, they stay apart; where some do and some do not, those that go all their way must
// end on their side of the plane that stands still, too. One invocation per pair.
//
// Those that do not are asked, which may ask others: rounds of it, from one set of counters into the other.
// What is still wrong after the last one is seen by LAST: then all vertices keep to their planes.
//
// Based on: the fixed point of a monotone rule, cut short.
// Departures: counters only grow, and what is counted twice is as good as once, so order does not matter.
// Bytes per pair: 20 + 4 a corner, 32 + 32 a corner where some are asked, read; 4 a corner counted (float).
//! variant last LAST=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint capacity;
    uint vertices;
};

READ(0, ContactPair, pair);
READ(1, rvec4, low);
READ(2, rvec4, delta); // m
READ(3, uint, control);
READ(4, rvec4, row);  // as guarantee_plane leaves it
READ(5, uint, asked); // above 0: keeps to its planes
COUNTERS(6, next);    // the same after this round; LAST: word `vertices`, corners that were still wrong

/// Whether a corner that goes all its way ends beyond its side of the plane.
INLINE bool is_beyond(uint v, rvec3 normal, real room)
{
    return dot(normal, rvec3(delta[v]) - rvec3(low[v])) < -room;
}

KERNEL(capacity)
{
    if (i < control[TAUT_CONTACT_LISTED])
    {
        ContactPair p = pair[i];
        bool a = asked[p.a] > 0u;
        bool b = asked[p.b] > 0u;
        bool c = asked[p.c] > 0u;
        bool d = asked[p.d] > 0u;
        if (a || b || c || d)
        {
            rvec4 plane = row[2u * i];
            rvec4 room = row[2u * i + 1u];
            rvec3 n = rvec3(plane);
            bool wrong_a = !a && is_beyond(p.a, n, room.x);
            bool wrong_b = !b && is_beyond(p.b, plane.w < real(0) ? n : -n, room.y);
            bool wrong_c = !c && is_beyond(p.c, -n, room.z);
            bool wrong_d = !d && is_beyond(p.d, -n, room.w);
            COUNT_EVENT_IF(a || wrong_a, next, p.a);
            COUNT_EVENT_IF(b || wrong_b, next, p.b);
            COUNT_EVENT_IF(c || wrong_c, next, p.c);
            COUNT_EVENT_IF(d || wrong_d, next, p.d);
#if LAST
            COUNT_EVENT_IF(wrong_a || wrong_b || wrong_c || wrong_d, next, vertices);
#endif
        }
    }
}
