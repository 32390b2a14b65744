// Sums over a work group of TAUT_LINEAR_GROUP lanes in an order that never varies: what makes a dot product
// repeat to the last bit, and agree between executors.
//
// Passes of kernels/linear share `count` rows among `groups` groups, `chunk` rows each. A pass that makes a
// dot product leaves one partial sum a group; the next pass adds them up itself, every group the same way,
// so that no pass of one group stands between them.
//
// Based on:
//   Harris. Optimizing Parallel Reduction in CUDA. 2007. (the tree: each half of the lanes onto the other)
// Departures: a group takes a chunk of rows of its own instead of every n-th row, and the second stage is in
//   the pass that wants the sum.
#ifndef TAUT_SHARED_REDUCE_GLSL
#define TAUT_SHARED_REDUCE_GLSL

/// sum[0] becomes the sum over sum[0..TAUT_LINEAR_GROUP-1].
#define SUM_LANES(sum)                                                      \
    for (uint taut_width = uint(TAUT_LINEAR_GROUP) / 2u; taut_width > 0u; taut_width /= 2u) \
    {                                                                       \
        LANES_BEGIN(taut_width)                                             \
        sum[lane] += sum[lane + taut_width];                                \
        LANES_END                                                           \
    }

/// The same for two arrays at once: half the barriers.
#define SUM_LANES_2(sum, other)                                             \
    for (uint taut_width = uint(TAUT_LINEAR_GROUP) / 2u; taut_width > 0u; taut_width /= 2u) \
    {                                                                       \
        LANES_BEGIN(taut_width)                                             \
        sum[lane] += sum[lane + taut_width];                                \
        other[lane] += other[lane + taut_width];                            \
        LANES_END                                                           \
    }

#define CLEAR_LANES(sum) \
    PHASE_BEGIN          \
    sum[lane] = real(0); \
    PHASE_END

/// sum[0] becomes the sum over partials[first .. first + n - 1]. `sum` is SHARED.
#define SUM_PARTIALS(sum, partials, first, n)          \
    CLEAR_LANES(sum)                                   \
    EACH_BEGIN(0u, n)                                  \
    sum[lane] += partials[uint(first) + i];            \
    EACH_END                                           \
    SUM_LANES(sum)

#endif
