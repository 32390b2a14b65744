#pragma once
// The kernels that the build compiled in.

#include "taut/runtime/base/kernel_info.hpp"

#include <vector>

namespace taut {

/// Every kernel in every variant and precision.
std::vector<const KernelInfo*> all_kernels();

/// Throws Error{unsupported} naming what was asked for.
const KernelInfo& find_kernel(std::string_view name, std::string_view variant = {},
                              Precision precision = Precision::float32);

} // namespace taut
