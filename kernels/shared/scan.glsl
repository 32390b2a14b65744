// Sums of all lanes up to each one, over a work group of TAUT_LINEAR_GROUP lanes: what puts the elements that
// carry a flag side by side in their own order. Of integers, so the order of additions does not matter.
//
// Based on: Hillis, Steele. Data Parallel Algorithms. CACM 1986.
// Departures: every round goes through a second array, so that no lane reads what another writes.
#ifndef TAUT_SHARED_SCAN_GLSL
#define TAUT_SHARED_SCAN_GLSL

/// sum[lane] becomes sum[0] + ... + sum[lane].
#define SCAN_LANES(sum, other)                                                                      \
    for (uint taut_reach = 1u; taut_reach < uint(TAUT_LINEAR_GROUP); taut_reach *= 2u)              \
    {                                                                                               \
        PHASE_BEGIN                                                                                 \
        other[lane] = sum[lane] + (lane >= taut_reach ? sum[lane - min(taut_reach, lane)] : 0u);    \
        PHASE_END                                                                                   \
        PHASE_BEGIN                                                                                 \
        sum[lane] = other[lane];                                                                    \
        PHASE_END                                                                                   \
    }

#endif
