// Chebyshev acceleration of the sweeps: x <- omega (x - x_before_last) + x_before_last. One invocation per
// vertex; keeps the last two iterates.
//
// Based on: Wang. A Chebyshev Semi-Iterative Approach for Accelerating Projective and Position-based
//   Dynamics. SIGGRAPH Asia 2015, equation 5.
// Departures: acts before an iteration on what contacts left of the one before, so that the last word of a
//   substep is a sweep and its contacts; a body that ran away (vbd_progress) is left alone.
// Bytes per element: 56 read, 48 written (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
    float omega; // 1: only keeps the iterates
};

UPDATE(0, rvec4, delta);   // m
UPDATE(1, rvec4, newest);  // the iterate before, m
UPDATE(2, rvec4, older);   // the one before that, m
READ(3, uint, support);    // 2 * body + ...
READ(4, real, progress);   // two values a body: ..., 1 while it may be accelerated

KERNEL(count)
{
    rvec4 x = delta[i];
    rvec4 base = older[i];
    bool on = omega != 1.0f && progress[2u * (support[i] / 2u) + 1u] > real(0);
    rvec3 fast = (rvec3(x) - rvec3(base)) * real(omega) + rvec3(base);
    x = on ? rvec4(fast, x.w) : x;
    older[i] = newest[i];
    newest[i] = x;
    delta[i] = x;
}
