// How much of gravity the acceleration of the substep showed, for the start of the next: the new velocity
// less the old one is (displacement - inertial guess) / h + h g. One invocation per vertex.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024, section 3.7.
// Departures: without gravity, and in bodies that no contact can hold and no pin holds, the share is 1; with
//   contacts, vertices that a collider moved are counted by body.
// Bytes per element: 36 read, 4 written; contact 16 more (float).
//! variant contact CONTACT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, rvec4, predicted); // m
READ(1, rvec4, delta);     // m
READ(2, uint, support);    // 2 * body + (1: it has held vertices)
WRITE(3, real, share);
READ_ONE(4, StepValues, step_values);
#if CONTACT
UPDATE(5, rvec4, solved);   // the displacement before the last contacts, m; becomes what they added
COUNTERS(6, touched);       // by body
#endif

KERNEL(count)
{
    real h = step_values[0].substep;
    rvec3 gravity = rvec3(step_values[0].gravity_x, step_values[0].gravity_y, step_values[0].gravity_z);
    rvec3 fall = gravity * (h * h);
    real whole = dot(fall, fall);
    rvec3 end = rvec3(delta[i]);
    real shown = real(1) + dot(end - rvec3(predicted[i]), fall) / (whole > real(0) ? whole : real(1));
    bool known = whole > real(0) && shown < real(1);
    shown = known ? max(shown, real(0)) : real(1);
#if CONTACT
    share[i] = shown;
    rvec3 before = rvec3(solved[i]);
    if (before.x != end.x || before.y != end.y || before.z != end.z)
        COUNT_EVENT(touched, support[i] / 2u);
    solved[i] = rvec4(end - before, real(0));
#else
    share[i] = support[i] % 2u != 0u ? shown : real(1);
#endif
}
