// The last word on where a vertex goes in a substep: where it is asked to, or would leave its bound, its way
// is cut so that it keeps the room that each of its pairs left it, and stays near its forecast. One
// invocation per vertex.
//
//   slide: d += s n (need - s n . d) where s n . d < need, in the order of the pairs: three rounds, or, of a
//     vertex that held corners push, until nothing is missing, at most 64;
//   scale: d *= min (-need / (-s n . d)), of one that nothing pushes: a share of a push is too little of it;
//     then within the bound about its forecast, by halving;
//   need = -0.9 room, or -room where it is negative and the vertex must move.
//
// Standing still is allowed whatever the rooms are, as long as nothing that is held pushes. What fits nowhere
// stands still.
//
// Based on: Chen et al. Divide and truncate, 2026, arXiv 2604.15513 (scaling by the planes of a vertex),
//   through the codes that follow it.
// Departures: sliding first (Agmon. The Relaxation Method for Linear Inequalities. Canadian Journal of
//   Mathematics 6, 1954) keeps what of the way is along the planes; without pushes it never makes a way
//   longer, since all half spaces hold the place where it starts.
// Bytes per vertex: 88 read, 16 written, 36 a corner and round read (float).
#include "shared/portable.glsl"
#include "shared/contact_rows.h"
#include "shared/guarantee.glsl"

PARAMS
{
    uint count; // vertices
};

READ(0, uint, start);     // of each vertex among `corner`, and the end
READ(1, uint, corner);    // 4 pair + corner
READ(2, real, row);       // 8 a pair, as guarantee_plane leaves it
READ(3, rvec4, low);
READ(4, uint, asked);     // above 0: keeps to its planes; one more word: all do
UPDATE(5, rvec4, anchor); // as guarantee_anchor says
UPDATE(6, rvec4, delta);  // m
COUNTERS(7, lost);

/// What a pair asks of one of its corners: s n . d at least -room.
struct Ask
{
    rvec3 normal; // s n
    real room;
    real margin;
};

INLINE Ask ask_of(uint c)
{
    uint at = 8u * (c >> 2u);
    uint k = c & 3u;
    real sized = row[at + 3u];
    bool first = k == 0u || (k == 1u && sized < real(0));
    rvec3 n = rvec3(row[at], row[at + 1u], row[at + 2u]);
    Ask ask;
    ask.normal = first ? n : -n;
    ask.room = row[at + 4u + k];
    ask.margin = abs(sized);
    return ask;
}

real need_of(Ask ask)
{
    return ask.room < real(0) ? -ask.room : REAL(-0.9) * ask.room;
}

/// Whether a held corner pushes.
bool must_move(Ask ask)
{
    return ask.room < REAL(-0.6) * ask.margin && ask.room > REAL(-1e29);
}

/// `way` after sliding along every plane of the corners first..end-1, as often as `rounds`.
rvec3 slide(rvec3 way, uint first, uint end, uint rounds)
{
    bool slides = true;
    for (uint round = 0u; round < rounds && slides; ++round)
    {
        slides = false;
        for (uint k = first; k < end; ++k)
        {
            Ask ask = ask_of(corner[k]);
            real missing = need_of(ask) - dot(ask.normal, way);
            if (missing > real(0) && ask.room > REAL(-1e29))
            {
                way += ask.normal * missing;
                slides = true;
            }
        }
    }
    return way;
}

/// The share of `way` that every plane with room leaves.
real share_left(rvec3 way, uint first, uint end)
{
    real share = real(1);
    for (uint k = first; k < end; ++k)
    {
        Ask ask = ask_of(corner[k]);
        real room = REAL(0.9) * ask.room + REAL(0.0625) * ask.margin;
        real taken = -dot(ask.normal, way);
        if (ask.room >= real(0) && taken > room)
            share = min(share, room / taken);
    }
    return share;
}

/// A share of `way` that ends within `bound` of the forecast, near to the greatest; it starts at `from`.
real share_within(rvec3 from, rvec3 way, rvec3 forecast, real bound)
{
    real share = real(0);
    real step = real(0.5);
    for (uint k = 0u; k < 8u; ++k)
    {
        bool inside = beyond_forecast(from + way * (share + step), forecast) <= bound;
        share = inside ? share + step : share;
        step = step * real(0.5);
    }
    return share;
}

KERNEL(count)
{
    rvec4 wanted = delta[i];
    rvec3 rest = rvec3(low[i]);
    rvec4 about = anchor[2u * i];
    rvec3 forecast = rvec3(anchor[2u * i + 1u]);
    rvec3 from = rvec3(about);
    rvec3 whole = rvec3(wanted) - rest;
    rvec3 way = whole;
    // As guarantee_begin asks: a vertex of no pair is in no round that would pass that on.
    bool leaves = !keeps_to(from + whole, forecast, about.w);
    if (about.w < real(-1.5))
    {
        bool strays = beyond_forecast(from + whole, forecast) > (real(-2) - about.w) * REAL(1.0001);
        COUNT_EVENT_IF(strays, lost, TAUT_CONTACT_PINCHED);
    }
    else if (asked[i] > 0u || asked[count] > 0u || leaves)
    {
        uint first = start[i];
        bool parted = about.w >= real(0);
        uint end = parted ? start[i + 1u] : first;
        real bound = max(about.w, real(0));
        bool pushed = false;
        for (uint k = first; k < end; ++k)
            pushed = pushed || must_move(ask_of(corner[k]));
        way = parted ? slide(whole, first, end, pushed ? 64u : 3u) : rvec3(real(0));
        if (!pushed)
            way = way * share_left(way, first, end);
        // What is pushed leaves its bound rather than be run over.
        bool inside = beyond_forecast(from + way, forecast) <= bound * REAL(1.0001);
        if (!pushed && !inside)
            way = way * share_within(from, way, forecast, bound);
        bool fits = true;
        for (uint k = first; k < end; ++k)
        {
            Ask ask = ask_of(corner[k]);
            fits = fits && dot(ask.normal, way) >= -ask.room - REAL(0.125) * ask.margin;
            parted = parted && ask.room > REAL(-1e29);
        }
        real size = dot(way, way);
        bool longer = !pushed && size > dot(whole, whole) * REAL(1.0001);
        if (!fits || longer || !parted || !IS_FINITE(size))
            way = rvec3(real(0));
        bool cut = way.x != whole.x || way.y != whole.y || way.z != whole.z;
        if (cut)
            delta[i] = rvec4(way + rest, wanted.w);
        COUNT_EVENT_IF(cut, lost, TAUT_CONTACT_FILTERED);
        COUNT_EVENT_IF(pushed && !(fits && inside), lost, TAUT_CONTACT_PINCHED);
        COUNT_EVENT_IF(!parted, lost, TAUT_CONTACT_HELD);
    }
    // Half used up: the next substep begins with a search.
    bool strays = about.w != real(-1) && beyond_forecast(from + way, forecast) >
                                             real(0.5) * (about.w < real(0) ? real(-2) - about.w : about.w);
    COUNT_EVENT_IF(strays, lost, TAUT_CONTACT_STRAYED);
    anchor[2u * i] = rvec4(from + way, about.w);
}
