// Conjugate gradients on small systems side by side: one group solves one system, from r = b - A x to the
// residual formed anew that confirms the answer. A turn makes one iteration or forms the residual anew, then
// decides as cg_direction does. What is not done after the turns of one dispatch goes on in the next.
//
// Based on: shared/cg_state.glsl; cg_direction, cg_step, cg_restart and cg_collect, whose order this keeps.
// Departures: a lane owns whole rows, so r, q and x never leave it; only the direction is shared.
// Bytes per row and iteration (float): 32 read and 16 written, besides 8 read per entry.
//! variant pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"
#include "shared/cg_state.glsl"

PARAMS
{
    uint systems;
    uint rows;    // of all systems together
    uint entries; // likewise
    uint history; // words of it a system
};

READ(0, uint, table);        // a system: first row, rows, turns of a dispatch; then rows + 1 row starts
READ(1, uint, column);       // counted within the system
READ(2, real, value);        // entries; with PAIRS as many low words behind
READ(3, real, given);        // rows of each: inverse of the diagonal (0: held), b; with PAIRS b low
GROUP_UPDATE(4, real, base); // x when the residual was last formed; with PAIRS as many low words behind
UPDATE(5, real, work);       // rows of each: r, p between dispatches, q, x gained since `base`
UPDATE(6, CgState, state);   // a system
UPDATE(7, uint, control);    // a system: 1 where the residual is wanted anew, then the history

SHARED(real, direction, TAUT_SMALL_ROWS);
SHARED(real, sum_rz, TAUT_LINEAR_GROUP);
SHARED(real, sum_rr, TAUT_LINEAR_GROUP);
SHARED(real, sum, TAUT_LINEAR_GROUP); // p.q, or b.b

real row_product(uint row)
{
    uint end = table[3u * systems + row + 1u];
    real total = real(0);
    for (uint k = table[3u * systems + row]; k < end; ++k)
        total += value[k] * direction[column[k]];
    return total;
}

real row_residual(uint first, uint row)
{
    uint end = table[3u * systems + row + 1u];
#if PAIRS
    TwoFloat left = two_float(given[rows + row], given[2u * rows + row]);
    for (uint k = table[3u * systems + row]; k < end; ++k)
    {
        uint at = first + column[k];
        TwoFloat x = two_float(base[at], base[rows + at]);
        TwoFloat part = two_float_multiply(two_float(value[k], value[entries + k]), x);
        left = two_float_add2(left, two_float_negate(part));
    }
    return left.high + left.low;
#else
    real left = given[rows + row];
    for (uint k = table[3u * systems + row]; k < end; ++k)
        left -= value[k] * base[first + column[k]];
    return left;
#endif
}

/// base += gained.
void collect(uint row, real gained)
{
#if PAIRS
    TwoFloat total = two_float_add(two_float(base[row], base[rows + row]), gained);
    base[row] = total.high;
    base[rows + row] = total.low;
#else
    base[row] += gained;
#endif
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint system = min(group, systems - 1u);
    CgState s = state[system];
    bool idle = group >= systems || s.status != uint(TAUT_CG_RUNNING);
    uint first = table[3u * system];
    uint n = idle ? 0u : table[3u * system + 1u];
    uint turns = idle ? 0u : table[3u * system + 2u];
    uint words = system * (1u + history);
    bool anew = control[words] != 0u;
    EACH_BEGIN(0u, n)
    direction[i] = work[rows + first + i];
    EACH_END
    for (uint turn = 0u; turn < turns && s.status == uint(TAUT_CG_RUNNING); ++turn)
    {
        LANES_BEGIN(TAUT_LINEAR_GROUP)
        sum[lane] = real(0);
        sum_rz[lane] = real(0);
        sum_rr[lane] = real(0);
        LANES_END
        if (anew)
        {
            bool begin = s.begun == 0u;
            EACH_BEGIN(0u, n)
            uint row = first + uint(i);
            if (!begin)
                collect(row, work[3u * rows + row]);
            work[3u * rows + row] = real(0);
            EACH_END
            EACH_BEGIN(0u, n)
            uint row = first + uint(i);
            real m = given[row];
            real r = m > real(0) ? row_residual(first, row) : real(0);
            real b = m > real(0) ? given[rows + row] : real(0);
            work[row] = r;
            sum_rz[lane] += r * (m * r);
            sum_rr[lane] += r * r;
            sum[lane] += b * b;
            EACH_END
            SUM_LANES(sum)
            s.fresh = 1u;
            s.step = real(0);
            s.exhausted = 0u;
            s.replacements += begin ? 0u : 1u;
        }
        else
        {
            EACH_BEGIN(0u, n)
            uint row = first + uint(i);
            real q = row_product(row);
            work[2u * rows + row] = q;
            sum[lane] += direction[i] * q;
            EACH_END
            SUM_LANES(sum)
            s = cg_measure(s, sum[0]);
            real along = s.step;
            EACH_BEGIN(0u, n)
            uint row = first + uint(i);
            real m = given[row];
            real r = m > real(0) ? cg_advance(work[row], along, work[2u * rows + row]) : real(0);
            work[row] = r;
            sum_rz[lane] += r * (m * r);
            sum_rr[lane] += r * r;
            EACH_END
        }
        SUM_LANES_2(sum_rz, sum_rr)
        bool replace = false;
        bool keep = true;
        s = cg_next(s, sum_rz[0], sum_rr[0], sum[0], replace, keep);
        real step = s.step;
        bool stepping = keep && step != real(0);
        bool turning = s.status == uint(TAUT_CG_RUNNING) && !replace;
        uint reached = s.iteration;
        real beta = real(0);
        s.step = real(0);
        if (turning)
            beta = cg_turn(s, sum_rz[0]);
        bool conjugate = beta != real(0); // without: what is left in p from another solve may be anything
        EACH_BEGIN(0u, n)
        uint row = first + uint(i);
        real p = direction[i];
        real gained = work[3u * rows + row];
        real z = given[row] * work[row];
        work[3u * rows + row] = stepping ? gained + step * p : gained;
        direction[i] = turning ? z + (conjugate ? beta * p : real(0)) : p;
        EACH_END
        anew = replace;
        LANES_BEGIN(1)
        if (history > 0u)
            control[words + 1u + reached % history] = cg_history_word(s);
        LANES_END
    }
    EACH_BEGIN(0u, n)
    work[rows + first + i] = direction[i];
    EACH_END
    LANES_BEGIN(1)
    if (!idle)
    {
        state[system] = s;
        control[words] = anew ? 1u : 0u;
    }
    LANES_END
}
