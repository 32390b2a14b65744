// The product of a Newton step's matrix with a vector, its springs formed again from the places of their
// ends instead of stored: y = (M + h^2 K + h D) x without hinges, or the residual b - y. A lane a vertex.
//
// Based on: shared/implicit_spring.glsl.
// Departures: none.
// Bytes per vertex: 60 read, 12 written; per spring end 68 (float).
//! variant dot DOT=1
//! variant residual RESIDUAL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/implicit_spring.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
    float scale; // as in implicit_force
};

READ(0, rvec4, position); // m, w = inverse mass 1/kg
READ(1, rvec4, delta);    // m
READ(2, Spring, spring);
READ(3, uint, table); // as in implicit_force
READ_ONE(4, StepValues, step_values);
READ(5, real, x);
WRITE(6, real, y);
#if DOT
WRITE(7, real, partials); // sums of x_i y_i
#elif RESIDUAL
READ(7, real, b);
#endif

#if DOT
SHARED(real, sum, TAUT_LINEAR_GROUP);
#endif

rvec3 at(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

rvec3 product(uint i)
{
    rvec4 place = position[i];
    rvec4 moved = delta[i];
    rvec3 own = at(i);
    real h = step_values[0].substep;
    real mass = place.w > real(0) ? real(1) / place.w : real(0);
    PRECISE rvec3 result = own * mass;
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = TAUT_IMPLICIT_BEGIN(i); k < end; k += 2u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        Spring s = spring[word >> 1u];
        uint far = (word & 1u) == 0u ? s.b : s.a;
        rvec3 d = rvec3(place - position[far]) + rvec3(moved - delta[far]);
        SpringBlock block = spring_derivative(s.rest_length, s.stiffness, s.damping, d, h);
        result += spring_product(block, own - at(far));
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
    rvec3 result = product(v);
#if DOT
    sum[lane] += dot(at(v), result);
#elif RESIDUAL
    result = rvec3(b[3u * v], b[3u * v + 1u], b[3u * v + 2u]) - result;
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
