#include "hardware/roofline.hpp"

#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/limits.hpp"

#include <algorithm>
#include <stdexcept>

namespace taut::hardware {

Work& Work::operator+=(const Work& other)
{
    dispatches += other.dispatches;
    bytes += other.bytes;
    simd_cycles += other.simd_cycles;
    wave_cycles += other.wave_cycles;
    return *this;
}

Work work_of(const Table& table, const std::string& family, const Dispatch& pass, double trips)
{
    const KernelInfo& kernel = *pass.kernel;
    Row wanted{family, full_name(kernel), std::string(to_string(kernel.precision)), {}};
    const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                    [&](const Row& row) { return row.same_kernel(wanted); });
    if (found == table.rows.end())
        throw std::out_of_range("the table has no row for " + wanted.name());
    // The inverse throughput is of 64 invocations, whatever the wave; a group that is smaller takes as long.
    const double waves = static_cast<double>(group_count(kernel, pass.count)) *
                         std::max(1.0, static_cast<double>(kernel.group_size) / 64);
    const double longer = trips > 0 ? trips / kTripsAssumed : 1;
    Work out;
    out.dispatches = 1;
    out.simd_cycles = waves * longer * static_cast<double>(found->numbers[kInverseThroughput]);
    out.wave_cycles = longer * static_cast<double>(found->numbers[kLatency]);
    return out;
}

double Roofs::largest() const { return std::max({bytes, instructions, waves, dispatches}); }

const char* Roofs::dominant() const
{
    const double most = largest();
    return most == bytes          ? "bytes"
           : most == instructions ? "instructions"
           : most == waves        ? "waves"
                                  : "dispatches";
}

Roofs roofs_of(const Work& work, const Gpu& gpu, double latency)
{
    return {work.bytes / gpu.bandwidth, work.simd_cycles / (gpu.units * gpu.simds * gpu.clock),
            work.wave_cycles / gpu.clock, static_cast<double>(work.dispatches) * latency};
}

} // namespace taut::hardware
