#pragma once
// Inside of taut-kernelc: the struct by which callers name the bindings of a kernel.

#include "taut/runtime/compiler/compiler.hpp"

#include <memory>
#include <string>
#include <vector>

namespace taut {

/// `template <typename Binding> struct Bindings` of a kernel: a member for each name that any of its variants
/// binds. `kernels` are all its forms, variant by variant.
std::string bindings_text(const std::string& stem,
                          const std::vector<std::shared_ptr<const CompiledKernel>>& kernels);

} // namespace taut
