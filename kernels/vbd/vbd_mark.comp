// Keeps the displacements as they are before contacts, so that it shows which vertices contacts moved.
// One invocation per vertex. Bytes per element: 16 read, 16 written (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
};

READ(0, rvec4, delta);   // m
WRITE(1, rvec4, solved); // m

KERNEL(count)
{
    solved[i] = delta[i];
}
