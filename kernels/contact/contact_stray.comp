// Which vertices are not where the last search expected them, so that the list of pairs may lack some:
//
//   |x + d - x_0 - min(m, n) d_0| > bound,
//
// x_0 the place at the last search, d_0 the displacement of its substep, n the substeps that it looked ahead,
// m those up to the end of this one, d the displacement of this one. While no vertex does, no two have come
// nearer than the search allowed for by more than twice the bound. KEEP, of a search, sets x_0 and d_0.
// GUARD, with the guarantee, whose searches allow for any place on the way to n d_0: half of what
// guarantee_anchor lets a vertex stray from that is the bound. One invocation per vertex.
//
// Based on: Verlet. Computer "Experiments" on Classical Fluids. Physical Review 159, 1967 (lists that last
//   until something has moved by half of what they hold in reserve).
// Departures: what moves as expected uses nothing up.
// Bytes per vertex: 64 read; KEEP 32 read, 32 written (float).
//! variant keep KEEP=1
//! variant guarded GUARD=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#if GUARD
#include "shared/guarantee.glsl"
#endif

PARAMS
{
    uint count;    // vertices
    uint substeps; // that a search looks ahead
    float bound;   // m
};

READ(0, rvec4, position);
READ(1, rvec4, delta); // m
#if KEEP
WRITE(2, rvec4, place);
#else
READ(2, rvec4, place); // two a vertex: x_0, d_0, m
COUNTERS(3, lost);
#if !GUARD
READ(4, uint, control);
#endif
#endif

KERNEL(count)
{
#if KEEP
    place[2u * i] = position[i];
    place[2u * i + 1u] = delta[i];
#elif GUARD
    rvec3 way = rvec3((position[i] - place[2u * i]) + delta[i]);
    rvec3 forecast = rvec3(place[2u * i + 1u]) * real(substeps);
    real far = beyond_forecast(way, forecast);
    bool stays = IS_FINITE(far) && far <= real(bound) + REAL(0.5) * sway() * length(forecast);
    COUNT_EVENT_IF(!stays, lost, TAUT_CONTACT_STRAYED);
#else
    real known = real(min(control[TAUT_CONTACT_SINCE] + 1u, substeps));
    rvec3 off = rvec3(((position[i] - place[2u * i]) + delta[i]) - place[2u * i + 1u] * known);
    real far = dot(off, off);
    bool stays = IS_FINITE(far) && far <= real(bound) * real(bound);
    COUNT_EVENT_IF(!stays, lost, TAUT_CONTACT_STRAYED);
#endif
}
