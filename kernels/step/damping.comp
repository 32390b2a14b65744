// Velocity damping, dv/dt = -c v exactly over a substep. One invocation per vertex.
//
// Applied before gravity is added: the other order would scale gravity by exp(-c h) and bias the rest
// state (a static error of 0.8 % at c = 2/s and 4 substeps).
// Bytes per element: 16 read, 16 written (float).
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

UPDATE(0, rvec4, velocity); // m/s
READ_ONE(1, StepValues, step_values);

KERNEL(count)
{
    rvec4 v = velocity[i];
    v = v * step_values[0].damping_factor;
    v.w = real(0);
    velocity[i] = v;
}
