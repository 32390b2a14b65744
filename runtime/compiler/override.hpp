#pragma once
// Kernels edited without a rebuild: texts in the folder that TAUT_KERNEL_DIR names replace the built-in ones.

#include "taut/runtime/compiler/compiler.hpp"

#include <filesystem>
#include <memory>

namespace taut {

/// The text `$TAUT_KERNEL_DIR/**/<name>.comp`, compiled in the variant and precision of `kernel`, with the
/// includes of that folder. Null when the variable is unset or empty, or there is no such file.
/// Throws Error{kernel_compilation} when the text does not compile, lacks the variant, or has other
/// bindings, parameters or group size than `kernel`; Error{io} when the variable names no folder.
std::shared_ptr<const CompiledKernel> kernel_override(const KernelInfo& kernel);

/// The path of that text, not yet read; empty when the variable is unset or empty, or there is no such file.
/// Throws Error{io} when the variable names no folder, Error{kernel_compilation} when two texts fit.
std::filesystem::path kernel_override_file(const KernelInfo& kernel);

} // namespace taut
