// Conjugate gradients, first pass of an iteration: decides whether to go on, adds the last step to x and
// makes the next direction p = z + beta p. Also asks for the passes that come next, or for none.
//
// Based on: shared/cg_state.glsl.
// Departures: x takes its step one pass late, because here the residual after the step is known: a step
//   that led to a residual which is not finite is never taken, and p is read once for both uses.
// Bytes per row (float): 12 read (16 with a diagonal), 8 written.
//! variant diagonal DIAGONAL=1
//! variant block BLOCK=1
//! variant stored
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/cg_state.glsl"
#include "shared/active_rows.h"

PARAMS
{
    uint count;   // rows; with BLOCK block rows
    uint chunk;   // of them a group
    uint groups;
    uint history; // words of it in `control`
    uint last;    // 1: no iteration follows, so this is the limit
};

READ(0, real, residual); // r; in the variant `stored` z
UPDATE(1, real, direction);
UPDATE(2, real, x);
READ(3, real, partials); // groups of each: r.z, r.r, b.b
READ_ONE(4, CgState, before);
WRITE(5, CgState, after);
UPDATE(6, uint, control);
#if DIAGONAL
READ(7, real, inverse); // 1 / d; 0 = the row is held
#elif BLOCK
READ(7, real, inverse); // 6 a block row: xx xy xz yy yz zz
#endif
#if BLOCK
#include "shared/block_inverse.glsl"
#endif

SHARED(real, sum_rz, TAUT_LINEAR_GROUP);
SHARED(real, sum_rr, TAUT_LINEAR_GROUP);
SHARED(real, sum_bb, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    SUM_PARTIALS(sum_rz, partials, 0u, groups)
    SUM_PARTIALS(sum_rr, partials, groups, groups)
    CgState s = before[0];
    s.iteration_limit = last != 0u ? min(s.iteration_limit, s.iteration) : s.iteration_limit;
    uint unknown = s.begun == 0u ? groups : 0u;
    SUM_PARTIALS(sum_bb, partials, 2u * groups, unknown)
    bool replace = false;
    bool keep = true;
    s = cg_next(s, sum_rz[0], sum_rr[0], sum_bb[0], replace, keep);
    real step = s.step;
    bool stepping = keep && step != real(0);
    bool turning = s.status == uint(TAUT_CG_RUNNING) && !replace;
    uint reached = s.iteration;
    real beta = real(0);
    s.step = real(0);
    if (turning)
        beta = cg_turn(s, sum_rz[0]);
    bool conjugate = beta != real(0); // without: what is left in p from another solve may be anything

    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
#if BLOCK
    uint at = 3u * uint(i);
    rvec3 z = block_inverse_times(uint(i), rvec3(residual[at], residual[at + 1u], residual[at + 2u]));
    for (uint k = 0u; k < 3u; ++k)
    {
        real p = direction[at + k];
        x[at + k] = stepping ? x[at + k] + step * p : x[at + k];
        direction[at + k] = turning ? z[k] + (conjugate ? beta * p : real(0)) : p;
    }
#else
#if DIAGONAL
    real z = inverse[i] * residual[i];
#else
    real z = residual[i];
#endif
    real p = direction[i];
    real at = x[i];
    x[i] = stepping ? at + step * p : at;
    direction[i] = turning ? z + (conjugate ? beta * p : real(0)) : p;
#endif
    EACH_END

    LANES_BEGIN(1)
    if (group == 0u)
    {
        after[0] = s;
        uint used = control[TAUT_CONTROL_GROUPS];
        used = used == 0u ? groups : used;
        control[TAUT_CONTROL_ITERATE] = turning ? used : 0u;
        control[TAUT_CONTROL_REPLACE] = replace ? used : 0u;
        if (history > 0u)
            control[uint(TAUT_CONTROL_HISTORY) + reached % history] = cg_history_word(s);
    }
    LANES_END
}
