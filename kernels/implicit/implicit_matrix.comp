// M + h^2 K + h D of springs and dampers, assembled into 3 x 3 blocks by gathering: one invocation per vertex
// writes the blocks of its rows, its springs in their order.
//
// Based on: shared/implicit_spring.glsl.
// Departures: none.
// Bytes per vertex: 44 read, 36 written; per spring end 32 + 24 read, 36 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/implicit_spring.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count springs without a direction
    float scale; // as in implicit_force
};

READ(0, rvec4, position); // m, w = inverse mass 1/kg
READ(1, rvec4, delta);    // m
READ(2, Spring, spring);
READ(3, uint, table); // as in implicit_force
READ_ONE(4, StepValues, step_values);
UPDATE(5, real, values); // of the matrix
COUNTERS(6, events);

void put(uint at, real value, bool first) { values[at] = first ? value : values[at] + value; }

KERNEL(count)
{
    rvec4 x = position[i];
    rvec4 moved = delta[i];
    real h = step_values[0].substep;
    real mass = x.w > real(0) ? real(1) / x.w : real(0);
    rvec3 diagonal = rvec3(mass, mass, mass);
    rvec3 beside = rvec3(real(0)); // xy, xz, yz
    uint begin = TAUT_IMPLICIT_BEGIN(i);
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = begin; k < end; k += 2u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        Spring s = spring[word >> 1u];
        uint far = (word & 1u) == 0u ? s.b : s.a;
        rvec3 d = rvec3(x - position[far]) + rvec3(moved - delta[far]);
        SpringBlock block = spring_derivative(s.rest_length, s.stiffness, s.damping, d, h);
        real more = block.more;
        rvec3 n = block.n;
        rvec3 own = rvec3(more * (n.x * n.x) + block.across, more * (n.y * n.y) + block.across,
                          more * (n.z * n.z) + block.across);
        rvec3 mixed = rvec3(more * (n.x * n.y), more * (n.x * n.z), more * (n.y * n.z));
        diagonal += own;
        beside += mixed;
        uint place = table[k + 1u];
        if (place != TAUT_IMPLICIT_NOWHERE)
        {
            bool first = (place & TAUT_IMPLICIT_FIRST) != 0u;
            uint at = place & ~TAUT_IMPLICIT_FIRST;
            real unit = -real(scale);
            put(at, own.x * unit, first);
            put(at + TAUT_IMPLICIT_STRIDE, mixed.x * unit, first);
            put(at + 2u * TAUT_IMPLICIT_STRIDE, mixed.y * unit, first);
            put(at + 3u * TAUT_IMPLICIT_STRIDE, mixed.x * unit, first);
            put(at + 4u * TAUT_IMPLICIT_STRIDE, own.y * unit, first);
            put(at + 5u * TAUT_IMPLICIT_STRIDE, mixed.z * unit, first);
            put(at + 6u * TAUT_IMPLICIT_STRIDE, mixed.y * unit, first);
            put(at + 7u * TAUT_IMPLICIT_STRIDE, mixed.z * unit, first);
            put(at + 8u * TAUT_IMPLICIT_STRIDE, own.z * unit, first);
        }
        if (report != 0u)
        {
            if (table[k] != word && !spring_has_derivative(d, s.rest_length))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    uint centre = TAUT_IMPLICIT_DIAGONAL(i);
    if (centre != TAUT_IMPLICIT_NOWHERE)
    {
        real unit = real(scale);
        put(centre, diagonal.x * unit, true);
        put(centre + TAUT_IMPLICIT_STRIDE, beside.x * unit, true);
        put(centre + 2u * TAUT_IMPLICIT_STRIDE, beside.y * unit, true);
        put(centre + 3u * TAUT_IMPLICIT_STRIDE, beside.x * unit, true);
        put(centre + 4u * TAUT_IMPLICIT_STRIDE, diagonal.y * unit, true);
        put(centre + 5u * TAUT_IMPLICIT_STRIDE, beside.z * unit, true);
        put(centre + 6u * TAUT_IMPLICIT_STRIDE, beside.y * unit, true);
        put(centre + 7u * TAUT_IMPLICIT_STRIDE, beside.z * unit, true);
        put(centre + 8u * TAUT_IMPLICIT_STRIDE, diagonal.z * unit, true);
    }
}
