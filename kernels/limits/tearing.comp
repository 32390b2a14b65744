// Counts the springs that are longer than cloth bears. One invocation per spring; runs once a time step.
// Bytes per element: 16 spring + 32 read (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, DistanceConstraint, spring); // rest_length: that at which it tears, m
READ(1, rvec4, position);
COUNTERS(2, torn);

KERNEL(count)
{
    DistanceConstraint c = spring[i];
    real len = length(rvec3(position[c.a] - position[c.b]));
    if (len > c.rest_length)
        COUNT_EVENT(torn, 0);
}
