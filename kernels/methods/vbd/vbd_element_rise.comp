// Adds to the sums of vbd_rise by how much the displacements of a body raise the energy of one kind of
// element: one group for each that vbd_rise has, which takes its share of the body's elements.
//
// Based on: vbd_rise.comp; shared/element_rise.glsl.
// Departures: none.
// Bytes per element: its record, and 48 a corner (float).
//! each element of vbd
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/vbd_parts.h"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"
#include "shared/element_rise.glsl"

PARAMS
{
    uint groups;
};

READ(0, OF_ELEMENT(record), constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ(2, rvec4, low);      // m; the displacement of a vertex that stands still
READ(3, rvec4, delta);    // m
READ(4, uint, table);     // groups + 1: a group's elements are table[g] .. table[g + 1] - 1
UPDATE(5, real, sums);    // TAUT_VBD_SUMS a group

SHARED(real, sum, 64);

/// Where a vertex stands in the fallback, but for what moves all of the body alike.
rvec3 still(uint v) { return rvec3(position[v].w > real(0) ? low[v] : delta[v]); }

rvec3 before(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + (still(to) - still(from));
}

rvec3 change(uint from, uint to)
{
    return (rvec3(delta[to]) - still(to)) - (rvec3(delta[from]) - still(from));
}

real rise_of(uint k)
{
    OF_ELEMENT(record) c = constraint[k];
    uint v0 = OF_ELEMENT(v0)(c);
    rvec3 e1 = before(v0, OF_ELEMENT(v1)(c));
    rvec3 w1 = change(v0, OF_ELEMENT(v1)(c));
#if ELEMENT_CORNERS == 2
    return element_rise(c, e1, w1, real(1));
#else
    rvec3 e2 = before(v0, OF_ELEMENT(v2)(c));
    rvec3 w2 = change(v0, OF_ELEMENT(v2)(c));
#if ELEMENT_CORNERS == 3
    return element_rise(c, e1, e2, w1, w2, real(1));
#else
    rvec3 e3 = before(v0, OF_ELEMENT(v3)(c));
    rvec3 w3 = change(v0, OF_ELEMENT(v3)(c));
    return element_rise(c, e1, e2, e3, w1, w2, w3, real(1));
#endif
#endif
}

GROUP_KERNEL(64)
{
    uint mine = min(group, groups - 1u); // folded dispatches may bring groups too many
    PHASE_BEGIN
    sum[lane] = real(0);
    for (uint k = table[mine] + lane; k < table[mine + 1u]; k += 64u)
        sum[lane] += rise_of(k);
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        LANES_BEGIN(width)
        sum[lane] += sum[lane + width];
        LANES_END
    }
    LANES_BEGIN(1)
    if (group < groups)
        sums[TAUT_VBD_SUMS * mine] += sum[0];
    LANES_END
}
