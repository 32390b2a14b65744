// Adds the impulses of the air on the triangles at a vertex to its velocity. One invocation per vertex.
// Bytes per element: 4 + 20 a triangle + 32 read, 16 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, uint, first);     // of each vertex among `incident`, and the end
READ(1, uint, incident);  // triangles
READ(2, rvec4, impulse);  // N s, of a triangle on each corner
READ(3, rvec4, position); // w = inverse mass
UPDATE(4, rvec4, velocity); // m/s

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    for (uint k = first[i]; k < first[i + 1u]; ++k)
        sum += rvec3(impulse[incident[k]]);
    velocity[i] = rvec4(rvec3(velocity[i]) + sum * position[i].w, real(0));
}
