// Conjugate gradients, last pass of an iteration: alpha from p.Ap, r -= alpha q, and the partial sums of the
// new residual.
//
// Based on: shared/cg_state.glsl.
// Departures: the step along x is left to cg_direction.
// Bytes per row (float): 8 read (12 with a diagonal), 4 written.
//! variant diagonal DIAGONAL=1
//! variant block BLOCK=1
//! variant stored STORED=1
//! variant stored_held STORED=1 HELD=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/cg_state.glsl"

PARAMS
{
    uint count; // rows; with BLOCK block rows
    uint chunk;
    uint groups;
};

UPDATE(0, real, residual);
READ(1, real, product);    // q = A p
READ(2, real, curvatures); // one a group: p.q
WRITE(3, real, partials);  // groups of each: r.z, r.r
READ_ONE(4, CgState, before);
WRITE(5, CgState, after);
#if DIAGONAL || BLOCK || HELD
READ(6, real, inverse); // as in cg_direction; with HELD only whether it is 0
#endif
#if BLOCK
#include "shared/block_inverse.glsl"
#endif

SHARED(real, sum, TAUT_LINEAR_GROUP);
SHARED(real, sum_rz, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    SUM_PARTIALS(sum, curvatures, 0u, groups)
    CgState s = cg_measure(before[0], sum[0]);
    real step = s.step;
    PHASE_BEGIN // the sum was read by all lanes
    PHASE_END
    CLEAR_LANES(sum)
    CLEAR_LANES(sum_rz)
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
#if BLOCK
    uint block = uint(i);
    rvec3 r = rvec3(cg_advance(residual[3u * i], step, product[3u * i]),
                    cg_advance(residual[3u * i + 1u], step, product[3u * i + 1u]),
                    cg_advance(residual[3u * i + 2u], step, product[3u * i + 2u]));
    r = block_kept(block, r);
    residual[3u * i] = r.x;
    residual[3u * i + 1u] = r.y;
    residual[3u * i + 2u] = r.z;
    sum_rz[lane] += dot(r, block_inverse_times(block, r));
    sum[lane] += dot(r, r);
#else
    real r = cg_advance(residual[i], step, product[i]);
#if DIAGONAL
    real m = inverse[i];
    r = m > real(0) ? r : real(0);
    sum_rz[lane] += r * (m * r);
#endif
#if HELD
    r = inverse[i] > real(0) ? r : real(0);
#endif
    residual[i] = r;
    sum[lane] += r * r;
#endif
    EACH_END
    SUM_LANES_2(sum, sum_rz)
    LANES_BEGIN(1)
    if (group < groups)
    {
        partials[groups + group] = sum[0];
#if DIAGONAL || BLOCK
        partials[group] = sum_rz[0];
#elif !STORED
        partials[group] = sum[0]; // z = r
#endif
    }
    if (group == 0u)
        after[0] = s;
    LANES_END
}
