// Springs no longer than they may be: shortens those beyond it, one invocation per spring of one colour (no
// two share a vertex).
//
// Based on: Provot. Deformation constraints in a mass-spring model to describe rigid cloth behaviour.
//   Graphics Interface 1995, section 5 (the dynamic inverse procedure).
// Departures: springs go by colours, and both ends give way by their inverse masses; works on displacements
//   of the substep, so the velocity follows.
// Bytes per element: 16 spring + 64 read + 32 written (float).
//! lanes
//! variant tail TAIL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint first; // first spring of the colour; in the tail variant the table's first range
    uint count; // springs of the colour; groups in the tail variant
};

READ(0, DistanceConstraint, constraint); // rest_length: the greatest length, m
READ(1, rvec4, position);                // xyz m, w = inverse mass 1/kg
#if TAIL
GROUP_UPDATE(2, rvec4, delta); // displacement since the start of the substep, m
READ(3, uint, table);          // as in xpbd.comp
#else
UPDATE(2, rvec4, delta);
#endif

INLINE void project(ELEMENT k)
{
    DistanceConstraint c = constraint[k];
    rvec4 xa = position[c.a];
    rvec4 xb = position[c.b];
    rvec4 da = delta[c.a];
    rvec4 db = delta[c.b];
    rvec4 d = (xa - xb) + (da - db);
    real len = length(rvec3(d));
    real denominator = (xa.w + xb.w) * len;
    rbool beyond = len > c.rest_length && denominator > REAL(1e-30); // smaller would overflow
    real scale = (c.rest_length - len) / denominator;
    scale = SELECT(beyond, scale, real(0));
    rvec4 push = d * scale;
    push.w = real(0); // delta keeps its own
    delta[c.a] = da + push * xa.w;
    delta[c.b] = db - push * xb.w;
}

#include "shared/sweep.glsl"
