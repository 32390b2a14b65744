// Forces that the caller sets per vertex. One invocation per vertex.
// Bytes per element: 48 read, 16 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, rvec4, position);   // w = inverse mass
READ(1, rvec4, force);      // N
UPDATE(2, rvec4, velocity); // m/s
READ_ONE(3, StepValues, step_values);

KERNEL(count)
{
    real scale = position[i].w * step_values[0].substep;
    velocity[i] = rvec4(rvec3(velocity[i]) + rvec3(force[i]) * scale, real(0));
}
