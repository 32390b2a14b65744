// Adds elastic tetrahedra to the system of a Newton step: their forces to the right-hand side, their blocks
// to the matrix. Gathered: one invocation per vertex, tetrahedra in their order.
//
// Based on: implicit_solids.comp, whose results it takes to the corners by the chain rule.
// Departures: none.
// Bytes per vertex: 20 read, 12 updated; per tetrahedron at it 92 + 216 read, 144 updated (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/implicit_table.glsl"

PARAMS
{
    uint count;
    float lift; // as in implicit_force
};

READ(0, SolidTetrahedron, solid);
READ(1, real, state); // shared/solid_state.h
READ(2, uint, table); // shared/implicit_table.glsl; an entry is 4 * tetrahedron + corner, and four places
UPDATE(3, real, b);
UPDATE(4, real, values);
#include "shared/implicit_solid.glsl"

/// Own row times the 9 x 9 matrix: three 3 x 3 blocks, by columns, each of which meets a column of F.
struct Rows
{
    rvec3 a0, a1, a2;
    rvec3 b0, b1, b2;
    rvec3 c0, c1, c2;
};

rvec3 unit(uint axis)
{
    return rvec3(axis == 0u ? real(1) : real(0), axis == 1u ? real(1) : real(0),
                 axis == 2u ? real(1) : real(0));
}

/// What the force on the corner does where a column of F changes along `v`.
rvec3 first_column(uint at, rvec3 own, rvec3 v)
{
    return (own_times(at + 9u, v) * own.x + turned_times(at + 27u, v) * own.y) +
           turned_times(at + 36u, v) * own.z;
}
rvec3 second_column(uint at, rvec3 own, rvec3 v)
{
    return (block_times(at + 27u, v) * own.x + own_times(at + 15u, v) * own.y) +
           turned_times(at + 45u, v) * own.z;
}
rvec3 third_column(uint at, rvec3 own, rvec3 v)
{
    return (block_times(at + 36u, v) * own.x + block_times(at + 45u, v) * own.y) +
           own_times(at + 21u, v) * own.z;
}

void put(uint at, rvec3 column, bool first)
{
    values[at] = first ? column.x : values[at] + column.x;
    uint to = at + 3u * TAUT_IMPLICIT_STRIDE;
    values[to] = first ? column.y : values[to] + column.y;
    to += 3u * TAUT_IMPLICIT_STRIDE;
    values[to] = first ? column.z : values[to] + column.z;
}

void add(uint place, Rows r, rvec3 other)
{
    if (place != TAUT_IMPLICIT_NOWHERE)
    {
        bool first = (place & TAUT_IMPLICIT_FIRST) != 0u;
        uint at = place & ~TAUT_IMPLICIT_FIRST;
        put(at, (r.a0 * other.x + r.b0 * other.y) + r.c0 * other.z, first);
        put(at + TAUT_IMPLICIT_STRIDE, (r.a1 * other.x + r.b1 * other.y) + r.c1 * other.z, first);
        put(at + 2u * TAUT_IMPLICIT_STRIDE, (r.a2 * other.x + r.b2 * other.y) + r.c2 * other.z, first);
    }
}

KERNEL(count)
{
    rvec3 pull = rvec3(real(0));
    uint begin = TAUT_IMPLICIT_BEGIN(i);
    uint end = TAUT_IMPLICIT_BEGIN(i + 1u);
    for (uint k = begin; k < end; k += 5u)
    {
        uint word = table[k] & ~TAUT_IMPLICIT_FIRST;
        SolidTetrahedron t = solid[word >> 2u];
        uint at = TAUT_SOLID_STATE * (word >> 2u);
        rvec3 own = corner_row(t, word & 3u);
        pull -= stress_times(at, own);
        rvec3 x = unit(0u);
        rvec3 y = unit(1u);
        rvec3 z = unit(2u);
        Rows r;
        r.a0 = first_column(at, own, x);
        r.a1 = first_column(at, own, y);
        r.a2 = first_column(at, own, z);
        r.b0 = second_column(at, own, x);
        r.b1 = second_column(at, own, y);
        r.b2 = second_column(at, own, z);
        r.c0 = third_column(at, own, x);
        r.c1 = third_column(at, own, y);
        r.c2 = third_column(at, own, z);
        add(table[k + 1u], r, corner_row(t, 0u));
        add(table[k + 2u], r, corner_row(t, 1u));
        add(table[k + 3u], r, corner_row(t, 2u));
        add(table[k + 4u], r, corner_row(t, 3u));
    }
    if (begin < end)
    {
        rvec3 side = pull * real(lift);
        b[3u * i] += side.x;
        b[3u * i + 1u] += side.y;
        b[3u * i + 2u] += side.z;
    }
}
