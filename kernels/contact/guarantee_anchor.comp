// Where each vertex may be until the next search, whatever happens: surfaces whose pairs are not listed then
// cannot meet. One invocation per vertex.
//
//   |x - (x_0 + s f)| <= |f| / 10 + room (2 r + skin) for some s in [0, 1],   f = substeps d,
//
// room TAUT_GUARANTEE_ROOM in percent, x_0 where it is now, d the displacement of the first substep, r the
// radius of its surface: contact_search lists all pairs that these let meet. Where the list is too short, or
// a search was cut, all stand still, and so do vertices with more corners of pairs than can be looked at.
//
// Based on: Chen, Hsu, Liu, Macklin, Yang, Yuksel. Offset Geometric Contact. SIGGRAPH 2025 (bounds from what
//   a search has not found).
// Departures: the bound is about the way that the search looked along, so that speed does not meet it; where
//   it begins is within, so that standing still is allowed.
// Bytes per vertex: 56 read, 32 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/guarantee.glsl"

PARAMS
{
    uint count;    // vertices
    uint substeps; // until the next search
    float skin;    // m
};

READ(0, rvec4, position); // w = inverse mass; 0 is held
READ(1, rvec4, delta); // m, of the first substep
READ(2, rvec4, rest);  // w = body
READ(3, ContactBody, body);
READ(4, uint, control);
READ(5, uint, start);    // of the corners of pairs at each vertex, and the end
WRITE(6, rvec4, anchor); // two a vertex: way since then, m, w = bound, -1: stands still, -2 - bound: held; f

KERNEL(count)
{
    rvec4 x = position[i];
    rvec3 d = rvec3(delta[i]);
    real radius = body[uint(rest[i].w)].radius;
    rvec3 forecast = sound_way(rvec3(x), d) * real(substeps);
    real room = real(TAUT_GUARANTEE_ROOM) / real(100);
    real bound = length(forecast) * sway() + room * (real(2) * radius + real(skin));
    bool crowded = start[i + 1u] - start[i] > TAUT_CONTACT_CROWD;
    bool holds = control[TAUT_CONTACT_HOLDS] != 0u || crowded || !is_sound(rvec3(x), d);
    bool held = x.w == real(0);
    anchor[2u * i] = rvec4(rvec3(real(0)), held ? real(-2) - bound : (holds ? real(-1) : bound));
    anchor[2u * i + 1u] = rvec4(forecast, real(0));
}
