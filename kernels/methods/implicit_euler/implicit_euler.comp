// Adds one kind of element to the system of a Newton step: h^2 times its force to the right-hand side, h^2
// times its curvature to the matrix. Gathered: one invocation per vertex, elements in their order.
//
// Based on: Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, eq. 16.
//   shared/element_form.glsl: slopes and curvature.
// Departures: none.
// Bytes per vertex: 16 read, 12 written; per corner its record, 4 and 36 read a corner of the element, 36 and
//   36 updated (float).
//! each element of implicit_euler
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"
#include "shared/element_block.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count elements without a shape
    float scale; // as in implicit_force
    float lift;
};

READ(0, rvec4, position); // m
READ(1, rvec4, delta);    // m
READ(2, OF_ELEMENT(record), constraint);
READ(3, uint, table); // shared/implicit_table.glsl; an entry is corners * element + corner, a place a corner
READ_ONE(4, StepValues, step_values);
UPDATE(5, real, b);
UPDATE(6, real, values);
COUNTERS(7, events);

void put(uint at, rvec3 row, bool first)
{
    values[at] = first ? row.x : values[at] + row.x;
    uint to = at + TAUT_IMPLICIT_STRIDE;
    values[to] = first ? row.y : values[to] + row.y;
    to += TAUT_IMPLICIT_STRIDE;
    values[to] = first ? row.z : values[to] + row.z;
}

#ifdef ELEMENT_WITH_ENERGY
/// What the force at one corner does with the place of another, where there is a block for it.
void add(uint place, ElementBlock block, real factor)
{
    if (place != TAUT_IMPLICIT_NOWHERE)
    {
        bool first = (place & TAUT_IMPLICIT_FIRST) != 0u;
        uint at = place & ~TAUT_IMPLICIT_FIRST;
        put(at, block.x * factor, first);
        put(at + 3u * TAUT_IMPLICIT_STRIDE, block.y * factor, first);
        put(at + 6u * TAUT_IMPLICIT_STRIDE, block.z * factor, first);
    }
}
#else
void add(uint place, rvec3 row, rvec3 column)
{
    if (place != TAUT_IMPLICIT_NOWHERE)
    {
        bool first = (place & TAUT_IMPLICIT_FIRST) != 0u;
        uint at = place & ~TAUT_IMPLICIT_FIRST;
        put(at, column * row.x, first);
        put(at + 3u * TAUT_IMPLICIT_STRIDE, column * row.y, first);
        put(at + 6u * TAUT_IMPLICIT_STRIDE, column * row.z, first);
    }
}
#endif

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

KERNEL(count)
{
    real h = step_values[0].substep;
    rvec3 pull = rvec3(real(0));
    uint begin = TAUT_IMPLICIT_BEGIN(i);
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = begin; k < end; k += uint(ELEMENT_CORNERS) + 1u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        OF_ELEMENT(record) c = constraint[word / uint(ELEMENT_CORNERS)];
        uint corner = word % uint(ELEMENT_CORNERS);
        uint v0 = OF_ELEMENT(v0)(c);
        rvec3 e1 = between(v0, OF_ELEMENT(v1)(c));
#if ELEMENT_CORNERS > 2
        rvec3 e2 = between(v0, OF_ELEMENT(v2)(c));
#endif
#if ELEMENT_CORNERS > 3
        rvec3 e3 = between(v0, OF_ELEMENT(v3)(c));
#endif
        ElementForm form = element_form(c, ELEMENT_EDGES);
        pull -= slope_at(form, corner);
        // Also of a shape that is none: a block that holds nothing yet must not keep what the last step left.
#ifdef ELEMENT_WITH_ENERGY
        real factor = (h * real(scale)) * h;
        for (uint other = 0u; other < uint(ELEMENT_CORNERS); ++other)
            add(table[k + 1u + other], element_block(form, corner, other), factor);
#else
        rvec3 row = gradient_at(form, corner) * (((h * form.stiffness) * h) * real(scale));
        add(table[k + 1u], row, form.n0);
        add(table[k + 2u], row, form.n1);
#if ELEMENT_CORNERS > 2
        add(table[k + 3u], row, form.n2);
#endif
#if ELEMENT_CORNERS > 3
        add(table[k + 4u], row, form.n3);
#endif
#endif
        if (report != 0u)
        {
            if (!form.shaped && form.counted && table[k] != word)
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    if (begin < end)
    {
        rvec3 side = ((pull * h) * h) * (real(scale) * real(lift));
        b[3u * i] += side.x;
        b[3u * i + 1u] += side.y;
        b[3u * i + 2u] += side.z;
    }
}
