// How vertices read what kernels/implicit/implicit_solids.comp left. Included after the buffer `state`.
#ifndef TAUT_SHARED_IMPLICIT_SOLID_GLSL
#define TAUT_SHARED_IMPLICIT_SOLID_GLSL

#include "shared/solid_state.h"

rvec3 state_at(uint at) { return rvec3(state[at], state[at + 1u], state[at + 2u]); }

/// A block 01, 02 or 12 times a vector, and its transpose times one.
rvec3 block_times(uint at, rvec3 v)
{
    return rvec3(dot(state_at(at), v), dot(state_at(at + 3u), v), dot(state_at(at + 6u), v));
}
rvec3 turned_times(uint at, rvec3 v)
{
    return (state_at(at) * v.x + state_at(at + 3u) * v.y) + state_at(at + 6u) * v.z;
}
/// A block 00, 11 or 22 times a vector.
rvec3 own_times(uint at, rvec3 v)
{
    rvec3 a = state_at(at);
    rvec3 b = state_at(at + 3u);
    return rvec3(dot(a, v), dot(rvec3(a.y, b.x, b.y), v), dot(rvec3(a.z, b.y, b.z), v));
}

/// Stress by columns, times what multiplies F's columns: with corner_row the force on a corner, negative.
rvec3 stress_times(uint at, rvec3 row)
{
    return (state_at(at) * row.x + state_at(at + 3u) * row.y) + state_at(at + 6u) * row.z;
}

/// How F changes with a corner: its columns are this times the corner.
rvec3 corner_row(SolidTetrahedron t, uint corner)
{
    rvec3 b = rvec3(t.b00, t.b01, t.b02);
    rvec3 c = rvec3(t.b10, t.b11, t.b12);
    rvec3 d = rvec3(t.b20, t.b21, t.b22);
    rvec3 others = corner == 1u ? b : corner == 2u ? c : d;
    return corner == 0u ? -((b + c) + d) : others;
}

#endif
