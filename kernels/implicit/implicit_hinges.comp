// Adds the hinges to the system of a Newton step: h^2 f to its right-hand side, h^2 g g^T / compliance to its
// matrix, with g the gradients of the angle. Gathered: one invocation per vertex, hinges in their order.
//
// Based on:
//   shared/hinge.glsl.
//   Nocedal, Wright. Numerical Optimization, 2nd ed. 2006, 10.3 (Gauss-Newton): the curvature of the angle is
//   left out, so that the matrix stays positive semidefinite.
// Departures: none.
// Bytes per vertex: 52 read, 12 written; per hinge corner 44 + 96 read, 144 updated (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/hinge.glsl"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count;
    uint report; // 1: count hinges without an angle
    float scale; // as in implicit_force
    float lift;
};

READ(0, rvec4, position); // m
READ(1, rvec4, delta);    // m
READ(2, BendingConstraint, hinge);
READ(3, uint, table); // shared/implicit_table.glsl; an entry is 4 * hinge + corner, and four places
READ_ONE(4, StepValues, step_values);
UPDATE(5, real, b);
UPDATE(6, real, values);
COUNTERS(7, events);

void add(uint place, rvec3 row, rvec3 column)
{
    if (place != TAUT_IMPLICIT_NOWHERE)
    {
        bool first = (place & TAUT_IMPLICIT_FIRST) != 0u;
        uint at = place & ~TAUT_IMPLICIT_FIRST;
        for (uint e = 0u; e < 3u; ++e)
        {
            rvec3 term = column * (e == 0u ? row.x : e == 1u ? row.y : row.z);
            uint to = at + 3u * e * TAUT_IMPLICIT_STRIDE;
            values[to] = first ? term.x : values[to] + term.x;
            to += TAUT_IMPLICIT_STRIDE;
            values[to] = first ? term.y : values[to] + term.y;
            to += TAUT_IMPLICIT_STRIDE;
            values[to] = first ? term.z : values[to] + term.z;
        }
    }
}

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
    for (uint k = begin; k < end; k += 5u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        BendingConstraint c = hinge[word >> 2u];
        uint corner = word & 3u;
        HingeShape s = hinge_shape(between(c.edge0, c.edge1), between(c.edge0, c.wing0),
                                   between(c.edge0, c.wing1));
        if (s.shaped)
        {
            rvec3 own = s.edge0; // by ifs: of doubles Mesa 26's OpenGL gets a chain of ?: wrong
            if (corner == 1u)
                own = s.edge1;
            if (corner == 2u)
                own = s.wing0;
            if (corner == 3u)
                own = s.wing1;
            real stiffness = real(1) / c.compliance;
            pull -= own * (angle_difference(s.angle, c.rest_angle) * stiffness);
            rvec3 row = own * (((h * stiffness) * h) * real(scale));
            add(table[k + 1u], row, s.edge0);
            add(table[k + 2u], row, s.edge1);
            add(table[k + 3u], row, s.wing0);
            add(table[k + 4u], row, s.wing1);
        }
        else
        {
            // A block that holds nothing yet must not keep what the last step left.
            add(table[k + 1u], rvec3(real(0)), rvec3(real(0)));
            add(table[k + 2u], rvec3(real(0)), rvec3(real(0)));
            add(table[k + 3u], rvec3(real(0)), rvec3(real(0)));
            add(table[k + 4u], rvec3(real(0)), rvec3(real(0)));
            if (report != 0u)
            {
                if (table[k] != word)
                    COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
            }
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
