// Held vertices that move: puts each on the line between its places at the start and the end of the
// time step. One invocation per moving pin; runs after predict.
// Bytes per element: 68 read, 16 written (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
    uint substep;  // index within the time step
    uint substeps; // per time step
};

READ(0, uint, vertex);
READ(1, rvec4, pin_target); // two per pin: start and end of the time step, m
READ(2, rvec4, position);
UPDATE(3, rvec4, delta);

KERNEL(count)
{
    uint v = vertex[i];
    rvec3 from = rvec3(pin_target[2u * i]);
    rvec3 to = rvec3(pin_target[2u * i + 1u]);
    real t = real(substep + 1u) / real(substeps);
    rvec3 target = substep + 1u == substeps ? to : from + (to - from) * t;
    delta[v] = rvec4(target - rvec3(position[v]), delta[v].w);
}
