// Where a substep of vertex block descent begins, and what inertia weighs. One invocation per vertex.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024, section 3.7 (adaptive start:
//   gravity by the share of it that the last acceleration showed).
// Departures: the share is 1 at first, in a body that nothing holds and no collider touches, and in a body
//   that has just lost a contact: a few iterations could not make a stiff body fall that starts where it was.
// Bytes per element: 48 read, 32 written; adaptive 4 more, contact 16 more (float).
//! variant adaptive ADAPTIVE=1
//! variant contact ADAPTIVE=1 CONTACT=1
//! variant previous PREVIOUS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, rvec4, position);    // w = inverse mass, 1/kg
UPDATE(1, rvec4, predicted); // inertial guess of the displacement, m; w becomes m / h^2
UPDATE(2, rvec4, delta);     // m
READ_ONE(3, StepValues, step_values);
#if PREVIOUS
READ(4, rvec4, low); // m: the displacement that is none
#endif
#if ADAPTIVE
READ(4, real, share); // of gravity
#endif
#if CONTACT
READ(5, uint, support); // 2 * body + (1: it has held vertices)
READ(6, uint, touched); // by body: vertices that touched something, in all substeps so far
UPDATE(7, uint, seen);  // two words a vertex: that number one substep ago, and whether it grew then
#endif

KERNEL(count)
{
    real w = position[i].w;
    real per_substep = step_values[0].inverse_substep;
    rvec4 y = predicted[i];
    predicted[i] = rvec4(rvec3(y), w > real(0) ? (per_substep * per_substep) / w : real(0));
    rvec4 begin = y;
#if PREVIOUS
    begin = low[i];
#endif
#if ADAPTIVE
    real part = share[i];
#if CONTACT
    uint total = touched[support[i] / 2u];
    bool touches = total != seen[2u * i];
    bool held = support[i] % 2u != 0u;
    bool lost = seen[2u * i + 1u] != 0u && !touches;
    part = lost || !(held || touches) ? real(1) : part;
    seen[2u * i] = total;
    seen[2u * i + 1u] = touches ? 1u : 0u;
#endif
    real h = step_values[0].substep;
    rvec3 gravity = rvec3(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z);
    rvec3 fall = gravity * (h * h);
    begin = y - rvec4(fall * (real(1) - part), real(0));
#endif
    if (w > real(0))
        delta[i] = rvec4(rvec3(begin), delta[i].w);
}
