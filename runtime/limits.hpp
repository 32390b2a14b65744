#pragma once
// What every executor checks before it compiles a list, and how it folds large group counts.

#include "taut/runtime/device.hpp"

#include <cstdint>

namespace taut {

/// Throws Error{limit} naming the kernel, the limit and both numbers when the list asks for more
/// than `info.limits` gives (range and offset of a binding, shared memory, group size, parameters,
/// number of bindings, groups), Error{unsupported} for a double kernel on a device without 64-bit
/// floats, and Error{bad_input} for a list that contradicts itself (range outside its buffer).
void check_limits(const RecordingDesc& desc, const DeviceInfo& info);

/// Groups that a direct dispatch of `count` elements (KERNEL) or groups (GROUP_KERNEL) needs.
std::uint32_t group_count(const KernelInfo& kernel, std::uint32_t count);

/// Groups in x and y; the kernel's group number is y * fold.x + x.
struct GroupFold
{
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

/// Folds `count` groups into two dimensions of at most `max_per_dimension`. x * y >= count, exact
/// where count fits one dimension. Beyond that fewer than y groups may be left over: a KERNEL drops
/// them by its element count, a GROUP_KERNEL must compare `group` with its own count.
/// Throws Error{limit} when two dimensions are not enough.
GroupFold fold_groups(std::uint32_t count, std::uint32_t max_per_dimension);

} // namespace taut
