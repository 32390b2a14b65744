// A preconditioner of two levels, added up: z = D^-1 r + P A_c^-1 P^T r, and the partial sums of r.z.
//
// Based on:
//   Toselli, Widlund. Domain Decomposition Methods. 2005, chapter 3 (additive Schwarz with a coarse space).
// Departures: the parts of the fine level are single vertices (block Jacobi).
// Bytes per row (float): 13 read, 4 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint count; // block rows
    uint chunk; // of them a group
    uint groups;
};

READ(0, real, residual);
READ(1, real, inverse);   // D^-1, six a block row (shared/block_inverse.glsl)
READ(2, uint, aggregate); // of each block row; 0xffffffff: in none
READ(3, real, coarse);    // -A_c^-1 P^T r
WRITE(4, real, z);
WRITE(5, real, partials); // one a group: r.z
#include "shared/block_inverse.glsl"

SHARED(real, sum, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    CLEAR_LANES(sum)
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint block = uint(i);
    rvec3 r = rvec3(residual[3u * i], residual[3u * i + 1u], residual[3u * i + 2u]);
    bool inside = aggregate[i] != 0xffffffffu;
    uint at = inside ? 3u * aggregate[i] : 0u;
    rvec3 lift = block_kept(block, rvec3(coarse[at], coarse[at + 1u], coarse[at + 2u]));
    rvec3 fine = block_inverse_times(block, r);
    rvec3 out_z = inside ? fine - lift : fine;
    z[3u * i] = out_z.x;
    z[3u * i + 1u] = out_z.y;
    z[3u * i + 2u] = out_z.z;
    sum[lane] += dot(r, out_z);
    EACH_END
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
        partials[group] = sum[0];
    LANES_END
}
