// The 7-point Laplacian on nx x ny x nz unknowns with zero values around, x running fastest, without a
// matrix: y = scale (6 x - the sum of the six neighbours). The variant `step` is cg_step with the product
// formed again, which costs less than to store it and read it.
//
// Based on:
//   Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, 2.2 (central differences of Poisson's
//   equation, times the square of the mesh width).
//   shared/cg_state.glsl (step).
// Departures: a neighbour that is not there is read as the element itself, times 0, so that no lane
//   branches. PRECISE, because drivers take common factors (1 or 0 here) out of sums.
// Bytes per row (float), neighbours in the cache: 4 read, 4 written (residual 8 and 4; pairs 16 and 4);
// curvature 4 and 0; step 8 and 4.
//! variant dot DOT=1
//! variant curvature CURVATURE=1
//! variant residual RESIDUAL=1
//! variant residual_pairs PAIRS=1
//! variant step STEP=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/two_float.glsl"
#include "shared/cg_state.glsl"

PARAMS
{
    uint nx;
    uint ny;
    uint nz;
    uint chunk; // rows a group
    uint groups;
    float scale;
};

READ(0, real, x); // PAIRS: high and low word in turn, as b
#if CURVATURE
WRITE(1, real, partials); // sums of x_i (A x)_i
#elif STEP
UPDATE(1, real, residual);
READ(2, real, curvatures);
WRITE(3, real, partials); // groups of each: r.z, r.r
READ_ONE(4, CgState, before);
WRITE(5, CgState, after);
#else
WRITE(1, real, y);
#if DOT
WRITE(2, real, partials);
#elif RESIDUAL || PAIRS
READ(2, real, b);
#endif
#endif

SHARED(real, sum, TAUT_LINEAR_GROUP);

#if PAIRS
TwoFloat pair_at(uint i, real weight)
{
    return two_float(weight * x[2u * i], weight * x[2u * i + 1u]);
}
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint count = nx * ny * nz;
#if STEP
    SUM_PARTIALS(sum, curvatures, 0u, groups)
    CgState s = cg_measure(before[0], sum[0]);
    real step = s.step;
    PHASE_BEGIN // the sum was read by all lanes
    PHASE_END
#endif
    CLEAR_LANES(sum)
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    LINES_BEGIN(begin, end, nx)
    uint along_y = line % ny;
    uint south = along_y > 0u ? nx : 0u;
    uint north = along_y + 1u < ny ? nx : 0u;
    uint down = line >= ny ? nx * ny : 0u;
    uint up = line < ny * (nz - 1u) ? nx * ny : 0u;
    real has_south = south > 0u ? real(1) : real(0);
    real has_north = north > 0u ? real(1) : real(0);
    real has_down = down > 0u ? real(1) : real(0);
    real has_up = up > 0u ? real(1) : real(0);
    LINE_BEGIN(south > 0u && north > 0u && down > 0u && up > 0u) // inside: times 1 changes nothing
    uint west = line_first ? 0u : 1u;
    uint east = line_last ? 0u : 1u;
    real has_west = line_first ? real(0) : real(1);
    real has_east = line_last ? real(0) : real(1);
#if PAIRS
    TwoFloat beside = two_float_add2(pair_at(i - west, has_west), pair_at(i + east, has_east));
    TwoFloat in_y = two_float_add2(pair_at(i - south, has_south), pair_at(i + north, has_north));
    beside = two_float_add2(beside, in_y);
    beside = two_float_add2(beside, two_float_add2(pair_at(i - down, has_down), pair_at(i + up, has_up)));
    TwoFloat q = two_float_multiply(pair_at(i, real(1)), two_float(real(6), real(0)));
    q = two_float_multiply(two_float_add2(q, two_float_negate(beside)), two_float(real(scale), real(0)));
    TwoFloat r = two_float_add2(two_float(b[2u * i], b[2u * i + 1u]), two_float_negate(q));
    y[i] = r.high + r.low;
#else
    PRECISE real in_x = has_west * x[i - west] + has_east * x[i + east];
    PRECISE real beside_y = has_south * x[i - south] + has_north * x[i + north];
    PRECISE real beside_z = has_down * x[i - down] + has_up * x[i + up];
    PRECISE real in_y = line_inside ? x[i - south] + x[i + north] : beside_y;
    PRECISE real in_z = line_inside ? x[i - down] + x[i + up] : beside_z;
    PRECISE real q = real(scale) * (real(6) * x[i] - ((in_x + in_y) + in_z));
#if STEP
    real r = cg_advance(residual[i], step, q);
    residual[i] = r;
    sum[lane] += r * r;
#elif RESIDUAL
    y[i] = b[i] - q;
#elif !CURVATURE
    y[i] = q;
#endif
#if DOT || CURVATURE
    sum[lane] += x[i] * q;
#endif
#endif
    LINE_END
    LINES_END
#if DOT || CURVATURE || STEP
    SUM_LANES(sum)
    LANES_BEGIN(1)
    if (group < groups)
    {
        partials[group] = sum[0];
#if STEP
        partials[groups + group] = sum[0]; // z = r
#endif
    }
#if STEP
    if (group == 0u)
        after[0] = s;
#endif
    LANES_END
#endif
}
