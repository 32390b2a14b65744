// Moves each vertex by the mean of what its triangles were pushed by, each by the share of the pushes that it
// had:
//
//   d += sum_t s_t d_t / sum_t s_t.
//
// Two triangles that were pushed at their common edge move it as one would have. One invocation per vertex.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014, section 4.2 (averages
//   of corrections that were found at once).
// Departures: weighed by the shares, so that a push far from a vertex does not weaken one close to it.
// Bytes per vertex: 8, of one near a collider 4 + 8 a triangle more, 16 a triangle that was pushed, and then
// 16 read and written (float).
#include "shared/portable.glsl"
#include "shared/face_state.h"

PARAMS
{
    uint count; // vertices
    uint slots; // a triangle (face.comp)
    uint look;  // 1: triangles have just been told to be near or not
};

READ(0, uint, start);    // of each vertex among `incident`, and the end
READ(1, uint, incident); // slots times triangle + corner
READ(2, rvec4, slot);    // as face leaves it
READ(3, uint, state);    // likewise, of each triangle
UPDATE(4, rvec4, delta); // m
UPDATE(5, uint, near);   // 1: a triangle of the vertex may come near a collider in this time step

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    real share = real(0);
    uint any = 0u;
    uint begin = start[i];
    uint end = look != 0u || near[i] != 0u ? start[i + 1u] : begin;
    for (uint k = begin; k < end; ++k)
    {
        uint corner = incident[k];
        uint told = state[corner / slots];
        any = max(any, told);
        if (told == TAUT_FACE_PUSHED)
        {
            rvec4 way = slot[corner];
            sum += rvec3(way) * way.w;
            share += way.w;
        }
    }
    if (look != 0u)
        near[i] = min(any, 1u);
    if (share > real(0))
    {
        rvec4 d = delta[i];
        delta[i] = rvec4(rvec3(d) + sum / share, d.w);
    }
}
