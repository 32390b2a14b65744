// The guard of Chebyshev acceleration: one group per body sums how far the last iteration moved its vertices.
// A body in which that is more than in the first iteration runs away, and is not accelerated again in this
// substep.
// Bytes per vertex: 48 read (float).
#include "shared/portable.glsl"

PARAMS
{
    uint bodies;
    uint first_iteration; // 1: the sum becomes what later ones are compared with
};

READ(0, uint, start);      // bodies + 1: the vertices of body b are start[b] .. start[b + 1] - 1
READ(1, rvec4, position);  // w = inverse mass, 1/kg
READ(2, rvec4, delta);     // m, after the iteration
READ(3, rvec4, newest);    // m, before it
UPDATE(4, real, progress); // two values a body: the first sum, m^2 kg; 1 while it may be accelerated

SHARED(real, partial, 64);

GROUP_KERNEL(64)
{
    uint mine = min(group, bodies - 1u); // folded dispatches may bring groups too many
    PHASE_BEGIN
    real sum = real(0);
    for (uint v = start[mine] + lane; v < start[mine + 1u]; v += 64u)
    {
        real w = position[v].w;
        rvec3 moved = rvec3(delta[v] - newest[v]);
        sum += w > real(0) ? dot(moved, moved) / w : real(0);
    }
    partial[lane] = sum;
    PHASE_END
    for (uint width = 32u; width > 0u; width /= 2u)
    {
        PHASE_BEGIN
        if (lane < width)
            partial[lane] += partial[lane + width];
        PHASE_END
    }
    PHASE_BEGIN
    if (lane == 0u && group < bodies)
    {
        real sum = partial[0];
        real most = first_iteration != 0u ? sum : progress[2u * mine];
        bool on = first_iteration != 0u || progress[2u * mine + 1u] > real(0);
        progress[2u * mine] = most;
        progress[2u * mine + 1u] = on && sum <= most ? real(1) : real(0);
    }
    PHASE_END
}
