// What one kind of element brings to the blocks of the vertices of one colour: the force on each and the
// curvature there, gathered, one invocation per vertex. `vbd_solve` takes its step from it. The first kind
// begins with the inertia.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024: blocks f_i and H_i.
//   shared/element_form.glsl: slopes and curvature.
// Departures: blocks go through memory, a kind at a time, so that any number of kinds fits.
// Bytes per vertex: 12 + 16 read, 48 written, by further kinds updated; per corner its record, 4, and 32 a
//   corner of the element (float).
//! each element of vbd
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"
#include "shared/element_block.glsl"

PARAMS
{
    uint first;  // row
    uint count;  // rows of the colour
    uint begins; // 1: no other kind came before
    uint report; // 1: count elements without a shape
};

READ(0, OF_ELEMENT(record), constraint);
READ(1, rvec4, position);  // xyz m, w = inverse mass 1/kg
READ(2, rvec4, predicted); // xyz: inertial guess of the displacement, m; w = inertia m / h^2, kg/s^2
READ(3, rvec4, delta);     // displacement since the start of the substep, m
READ(4, uint, table);      // two words a row: vertex, first entry; an entry is corners * element + corner,
                           // with its highest bit where this vertex counts the element
UPDATE(5, rvec4, block);   // three a vertex: force N and inertia; xx yy zz; xy xz yz of the curvature, N/m
COUNTERS(6, events);

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

KERNEL(count)
{
    uint row = first + i;
    uint v = table[2u * row];
    rvec4 y = predicted[v];
    rvec3 f = rvec3(y - delta[v]) * y.w;
    rvec3 diagonal = rvec3(real(0));
    rvec3 mixed = rvec3(real(0));
    if (begins == 0u)
    {
        f = rvec3(block[3u * v]);
        diagonal = rvec3(block[3u * v + 1u]);
        mixed = rvec3(block[3u * v + 2u]);
    }
    uint end = table[2u * row + 3u];
    for (uint k = table[2u * row + 1u]; k < end; ++k)
    {
        uint word = table[k] & 0x7fffffffu;
        uint corner = word % uint(ELEMENT_CORNERS);
        OF_ELEMENT(record) c = constraint[word / uint(ELEMENT_CORNERS)];
        uint v0 = OF_ELEMENT(v0)(c);
        rvec3 e1 = between(v0, OF_ELEMENT(v1)(c));
#if ELEMENT_CORNERS > 2
        rvec3 e2 = between(v0, OF_ELEMENT(v2)(c));
#endif
#if ELEMENT_CORNERS > 3
        rvec3 e3 = between(v0, OF_ELEMENT(v3)(c));
#endif
        ElementForm form = element_form(c, ELEMENT_EDGES);
        f -= slope_at(form, corner);
#ifdef ELEMENT_WITH_ENERGY
        ElementBlock own = element_block(form, corner, corner);
        diagonal += rvec3(own.x.x, own.y.y, own.z.z);
        mixed += rvec3(own.x.y, own.x.z, own.y.z);
#else
        rvec3 g = gradient_at(form, corner);
        rvec3 stiff = g * form.stiffness;
        diagonal += g * stiff;
        mixed += rvec3(g.x * stiff.y, g.x * stiff.z, g.y * stiff.z);
#endif
        if (report != 0u)
        {
            if (!form.shaped && form.counted && table[k] != word)
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    block[3u * v] = rvec4(f, y.w);
    block[3u * v + 1u] = rvec4(diagonal, real(0));
    block[3u * v + 2u] = rvec4(mixed, real(0));
}
