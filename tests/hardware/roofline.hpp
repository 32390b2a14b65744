#pragma once
// A roofline on paper: what a step of cloth and an iteration of conjugate gradients would take on GPUs that
// were never tried, from the table of their compiler's estimates and published figures. A model, not a
// measurement.
//
// Based on: Williams, Waterman, Patterson. Roofline: an insightful visual performance model for multicore
//   architectures. CACM 2009.
// Departures: instructions are counted in cycles that the compiler estimates, not in operations; two further
//   roofs count what a chain of dispatches waits for.

#include "hardware/table.hpp"

#include "taut/runtime/base/dispatch.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut::hardware {

/// Published figures of one product of a family.
struct Gpu
{
    const char* name;
    const char* family; ///< of the table
    double units;       ///< compute units
    double simds;       ///< of a compute unit: 4 of 16 lanes (GCN), 2 of 32 (RDNA)
    double clock;       ///< Hz, boost
    double bandwidth;   ///< bytes/s
    const char* source;
};

inline constexpr Gpu kGpus[] = {
    {"RX 580", "polaris10", 36, 4, 1.340e9, 256e9,
     "[fpsbench](https://fpsbench.com/compare/gpu/"
     "amd-radeon-rx-580-vs-intel-arc-a770m), 2,304 lanes"},
    {"RX Vega 64", "vega10", 64, 4, 1.546e9, 484e9,
     "clock and 4,096 lanes [gamegpu](https://de.gamegpu.com/radeon-r-5xx-serie/Radeon-RX-Vega), bandwidth "
     "[TechPowerUp](https://techpowerup.com/review/amd-radeon-rx-vega-64/2.html)"},
    {"RX 6900 XT", "navi21", 80, 2, 2.250e9, 512e9,
     "[Wccftech](https://wccftech.com/"
     "amd-radeon-rx-6900-xt-big-navi-graphics-card-launches-heres-where-to-buy/)"},
};

/// Seconds from one dispatch to the next that depends on it.
struct Latency
{
    double seconds;
    const char* source;
};

/// Vulkan on RADV, in one command buffer: 941 dispatches of one group, each of which waits for the one
/// before.
inline constexpr Latency kRecorded = {
    0.876e-6,
    "[ROCm/rocm-systems#10834](https://github.com/ROCm/rocm-systems/issues/10834), Vulkan on a Radeon Pro "
    "W7900, 941 dependent dispatches of one group"};
/// A stream of kernels that do nothing, each launched by the host.
inline constexpr Latency kLaunched = {
    3e-6,
    "[NVIDIA developer forum](https://forums.developer.nvidia.com/t/too-much-time-for-kernel-launch-latency/"
    "233645/3), launch of a kernel that does nothing"};

/// What a list of dispatches asks for; sums over its passes.
struct Work
{
    std::uint64_t dispatches = 0;
    double bytes = 0;       ///< touched, caches left out (docs/decisions.md 12)
    double simd_cycles = 0; ///< of one SIMD: waves times inverse throughput
    double wave_cycles = 0; ///< of one wave of each pass, one after another

    Work& operator+=(const Work& other);
};

/// Trips that the compiler takes a loop to make (ACO, aco_statistics.cpp).
inline constexpr double kTripsAssumed = 8;

/// One pass without its bytes, on a family of the table. `trips`: those of the kernel's outer loop where they
/// are known, by which the compiler's cycles are corrected; 0: none are. Throws std::out_of_range where the
/// table has no such row.
Work work_of(const Table& table, const std::string& family, const Dispatch& pass, double trips = 0);

/// The four roofs, s.
struct Roofs
{
    double bytes = 0, instructions = 0, waves = 0, dispatches = 0;
    double largest() const;
    const char* dominant() const; ///< "bytes", "instructions", "waves" or "dispatches"
};

Roofs roofs_of(const Work& work, const Gpu& gpu, double latency = kRecorded.seconds);

/// The parts of docs/results/gpu.md that are made of the table and of plans. `most`: cells a side of the
/// largest cloth and of the largest system; 1024 on the page.
std::string page_gpus();
std::string page_cloth(const Table& table, std::uint32_t most);
std::string page_passes(const Table& table);
std::string page_dispatches(const Table& table, std::uint32_t most);
std::string page_gradients(const Table& table, std::uint32_t most);

} // namespace taut::hardware
