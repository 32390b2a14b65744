// Adds the part of one kind of element to the product of a Newton step's matrix with a vector, or takes it
// from a residual, with the curvature formed again from the places of the corners. A lane a vertex.
//
// Based on: implicit_euler.comp.
// Departures: none.
// Bytes per vertex: 24 read, 12 updated; per corner its record, 4, and 44 a corner of the element (float).
//! each element of implicit_euler
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"
#include "shared/element_block.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
    float scale; // as in implicit_force
};

READ(0, rvec4, position); // m
READ(1, rvec4, delta);    // m
READ(2, OF_ELEMENT(record), constraint);
READ(3, uint, table); // as in implicit_euler
READ_ONE(4, StepValues, step_values);
READ(5, real, x);
UPDATE(6, real, y);
#if DOT
WRITE(7, real, partials); // sums of x_i y_i, y as it is afterwards
#endif

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

rvec3 at(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

/// What an element makes of x at one of its corners.
rvec3 share_of(OF_ELEMENT(record) c, uint corner, real h)
{
    uint v0 = OF_ELEMENT(v0)(c);
    uint v1 = OF_ELEMENT(v1)(c);
    rvec3 e1 = between(v0, v1);
#if ELEMENT_CORNERS > 2
    uint v2 = OF_ELEMENT(v2)(c);
    rvec3 e2 = between(v0, v2);
#endif
#if ELEMENT_CORNERS > 3
    uint v3 = OF_ELEMENT(v3)(c);
    rvec3 e3 = between(v0, v3);
#endif
    ElementForm form = element_form(c, ELEMENT_EDGES);
#ifdef ELEMENT_WITH_ENERGY
    rvec3 result = block_times(element_block(form, corner, 0u), at(v0)) +
                   block_times(element_block(form, corner, 1u), at(v1));
#if ELEMENT_CORNERS > 2
    result += block_times(element_block(form, corner, 2u), at(v2));
#endif
#if ELEMENT_CORNERS > 3
    result += block_times(element_block(form, corner, 3u), at(v3));
#endif
    return result * (h * h);
#else
    rvec3 result = rvec3(real(0));
    if (form.shaped)
    {
        real change = dot(form.n0, at(v0)) + dot(form.n1, at(v1)); // of C
#if ELEMENT_CORNERS == 3
        change += dot(form.n2, at(v2));
#elif ELEMENT_CORNERS > 3
        change += dot(form.n2, at(v2)) + dot(form.n3, at(v3));
#endif
        result = gradient_at(form, corner) * (((h * form.stiffness) * h) * change);
    }
    return result;
#endif
}

rvec3 product(uint i)
{
    real h = step_values[0].substep;
    rvec3 result = rvec3(real(0));
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = TAUT_IMPLICIT_BEGIN(i); k < end; k += uint(ELEMENT_CORNERS) + 1u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        result += share_of(constraint[word / uint(ELEMENT_CORNERS)], word % uint(ELEMENT_CORNERS), h);
    }
    return result * real(scale);
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
#if DOT
    CLEAR_LANES(sum)
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint v = uint(i);
    rvec3 more = product(v);
#if RESIDUAL
    more = -more;
#endif
    rvec3 result = rvec3(y[3u * v], y[3u * v + 1u], y[3u * v + 2u]) + more;
#if DOT
    sum[lane] += dot(at(v), result);
#endif
    y[3u * v] = result.x;
    y[3u * v + 1u] = result.y;
    y[3u * v + 2u] = result.z;
    EACH_END
#if DOT
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
#endif
}
