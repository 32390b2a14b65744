// Sums of several reals a row over the rows of a body, in an order that never varies: groups leave one set
// each (body_parts.h), the next pass adds these up in every group alike.
//
// Based on: kernels/shared/reduce.glsl.
// Departures: n reals a lane, one beside the other in the SHARED array `sum` of 64 n.
#ifndef TAUT_SHARED_BODY_SUMS_GLSL
#define TAUT_SHARED_BODY_SUMS_GLSL

#define CLEAR_BODY_SUM(n)                 \
    for (uint k = 0u; k < uint(n); ++k)   \
        sum[uint(n) * lane + k] = real(0);

/// sum[0 .. n - 1] become the sums over all lanes.
#define SUM_BODY_LANES(n)                                                        \
    for (uint width = 32u; width > 0u; width /= 2u)                              \
    {                                                                            \
        LANES_BEGIN(width)                                                       \
        for (uint k = 0u; k < uint(n); ++k)                                      \
            sum[uint(n) * lane + k] += sum[uint(n) * (lane + width) + k];        \
        LANES_END                                                                \
    }

/// sum[0 .. n - 1] become those of groups from .. end - 1, which left them at values[first + stride * group].
#define SUM_BODY_PARTS(n, values, first, stride, from, end)                      \
    PHASE_BEGIN                                                                  \
    CLEAR_BODY_SUM(n)                                                            \
    for (uint j = (from) + lane; j < (end); j += 64u)                            \
        for (uint k = 0u; k < uint(n); ++k)                                      \
            sum[uint(n) * lane + k] += values[(first) + uint(stride) * j + k];   \
    PHASE_END                                                                    \
    SUM_BODY_LANES(n)

#endif
