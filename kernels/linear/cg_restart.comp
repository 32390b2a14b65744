// Conjugate gradients after the residual was formed anew, and at the very start: partial sums of it, held
// rows cleared, and the iteration set going again.
//
// Based on: shared/cg_state.glsl.
// Departures: none.
// Bytes per row (float): 4 read and written, at the start 4 more for b.
//! variant diagonal DIAGONAL=1
//! variant block BLOCK=1
//! variant stored STORED=1
//! variant stored_held STORED=1 HELD=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/cg_state.glsl"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // rows; with BLOCK block rows
    uint chunk;
    uint groups;
    uint begin_solve; // 1: `before` holds the settings, and b.b is wanted
    uint b_stride;    // words from one entry of b to the next: 2 where b is pairs
};

UPDATE(0, real, residual);
READ(1, real, b);         // where begin_solve is 0 anything
WRITE(2, real, partials); // groups of each: r.z, r.r, b.b
READ_ONE(3, CgState, before);
WRITE(4, CgState, after);
UPDATE(5, uint, control);
#if DIAGONAL || BLOCK || HELD
READ(6, real, inverse); // as in cg_direction; with HELD only whether it is 0
#endif
#if BLOCK
#include "shared/block_inverse.glsl"
#endif

SHARED(real, sum_rz, TAUT_LINEAR_GROUP);
SHARED(real, sum_rr, TAUT_LINEAR_GROUP);
SHARED(real, sum_bb, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    CLEAR_LANES(sum_rz)
    CLEAR_LANES(sum_rr)
    CLEAR_LANES(sum_bb)
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
#if BLOCK
    uint block = uint(i);
    rvec3 r = block_kept(block, rvec3(residual[3u * i], residual[3u * i + 1u], residual[3u * i + 2u]));
    residual[3u * i] = r.x;
    residual[3u * i + 1u] = r.y;
    residual[3u * i + 2u] = r.z;
    sum_rz[lane] += dot(r, block_inverse_times(block, r));
    sum_rr[lane] += dot(r, r);
    if (begin_solve != 0u)
    {
        rvec3 given = rvec3(b[3u * i * b_stride], b[(3u * i + 1u) * b_stride], b[(3u * i + 2u) * b_stride]);
        given = block_kept(block, given);
        sum_bb[lane] += dot(given, given);
    }
#else
    real r = residual[i];
    real keep = real(1);
#if DIAGONAL || HELD
    real m = inverse[i];
    keep = m > real(0) ? real(1) : real(0);
    r = m > real(0) ? r : real(0);
    residual[i] = r;
#endif
#if DIAGONAL
    sum_rz[lane] += r * (m * r);
#endif
    sum_rr[lane] += r * r;
    if (begin_solve != 0u)
    {
        real value = keep * b[i * b_stride];
        sum_bb[lane] += value * value;
    }
#endif
    EACH_END
    SUM_LANES_2(sum_rz, sum_rr)
    SUM_LANES(sum_bb)
    CgState s = before[0];
    s.fresh = 1u;
    s.step = real(0);
    s.exhausted = 0u;
    s.replacements += begin_solve == 0u ? 1u : 0u;
    LANES_BEGIN(1)
    if (group < groups)
    {
        partials[groups + group] = sum_rr[0];
#if DIAGONAL || BLOCK
        partials[group] = sum_rz[0];
#elif !STORED
        partials[group] = sum_rr[0];
#endif
        if (begin_solve != 0u)
            partials[2u * groups + group] = sum_bb[0];
    }
    if (group == 0u)
    {
        after[0] = s;
        uint used = control[TAUT_CONTROL_GROUPS];
        control[TAUT_CONTROL_ITERATE] = used == 0u ? groups : used;
        control[TAUT_CONTROL_ITERATE + 1] = 1u;
        control[TAUT_CONTROL_ITERATE + 2] = 1u;
#if STORED
        // Else the passes behind this one, which make z of the new residual, still need it.
        if (begin_solve != 0u)
#endif
            control[TAUT_CONTROL_REPLACE] = 0u;
        control[TAUT_CONTROL_REPLACE + 1] = 1u;
        control[TAUT_CONTROL_REPLACE + 2] = 1u;
    }
    LANES_END
}
