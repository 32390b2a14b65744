#pragma once
// The kernels that the build compiled in, and those that a program adds to them.

#include "taut/runtime/base/kernel_info.hpp"

#include <span>
#include <string>
#include <vector>

namespace taut {

/// Every kernel of Taut in every variant and precision.
std::vector<const KernelInfo*> all_kernels();

/// One of them, or of those that were registered. Throws Error{unsupported} naming what was asked for. Safe
/// from several threads, as register_kernels() is.
const KernelInfo& find_kernel(std::string_view name, std::string_view variant = {},
                              Precision precision = Precision::float32);

/// "distance:lambda", or "distance" of the form without a variant.
std::string full_name(const KernelInfo& kernel);

/// Adds kernels of a program's own, which must stay good for its whole life. Throws Error{bad_input} for a
/// name that is taken, and adds none then.
void register_kernels(std::span<const KernelInfo> kernels);

} // namespace taut
