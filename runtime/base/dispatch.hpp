#pragma once
// A dispatch as data, and the hazards between dispatches. No device is involved: the plan counts
// and proves barriers with this before any device exists, and every executor obeys the result.

#include "taut/runtime/base/kernel_info.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// Part of a buffer, named by a number that only the owner of the list understands.
struct BufferRange
{
    std::uint32_t buffer = 0;
    std::uint64_t offset = 0; ///< bytes
    std::uint64_t bytes = 0;
};

inline constexpr std::uint32_t kNoBuffer = std::numeric_limits<std::uint32_t>::max();

/// One launch of one kernel. Every field is fixed when the list is made; what changes from step
/// to step lives in buffers.
struct Dispatch
{
    const KernelInfo* kernel = nullptr;
    std::vector<BufferRange> bindings; ///< one per kernel->bindings, same order
    std::vector<std::byte> params;     ///< kernel->param_bytes bytes
    std::uint32_t count = 0;           ///< elements (KERNEL) or groups (GROUP_KERNEL)
    /// Three uint32 group counts {x, y, z} read on the device when the dispatch starts. `count` is
    /// then the largest possible count, and buffer kNoBuffer means a direct dispatch.
    BufferRange indirect = {kNoBuffer, 0, 0};
    std::string label; ///< the effect that this work belongs to; timings are summed by it
};

/// For each dispatch, whether a barrier must stand before it (element 0 is always false).
/// Greedy: a barrier is put only where a dispatch conflicts with one since the last barrier
/// (write after write, write after read, read after write on overlapping bytes).
std::vector<bool> derive_barriers(std::span<const Dispatch> dispatches);

/// Two dispatches that conflict with no barrier between them.
struct Hazard
{
    std::size_t first = 0;
    std::size_t second = 0;
    std::uint32_t buffer = 0;
    std::string text; ///< a sentence naming both kernels, the bindings and the bytes
};

/// All conflicts that `barrier_before` leaves open. Written separately from derive_barriers (it
/// compares every pair between two barriers), so that one can be the judge of the other.
std::vector<Hazard> find_hazards(std::span<const Dispatch> dispatches,
                                 const std::vector<bool>& barrier_before);

/// Throws std::logic_error with the first hazard, if there is one: a fault of the program, in every build,
/// because a missing barrier is a wrong result on some devices only.
void check_no_hazard(std::span<const Dispatch> dispatches, const std::vector<bool>& barrier_before);

} // namespace taut
