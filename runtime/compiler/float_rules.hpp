#pragma once
// Rules that make the bits of a kernel the same under every driver, as far as SPIR-V can say it.
//
// Based on: The Khronos Group. SPIR-V Specification, decoration NoContraction; Vulkan Specification, appendix
//   "Precision and Operation of SPIR-V Instructions": what it calls derived, or gives a bound of error, a
//   driver may compute in any order.
// Departures: division and the square root have such a bound, too, and are let pass: every driver met so far
//   rounds them correctly, and no other way to write them would be better.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// Throws Error{kernel_compilation} that names the first built-in function whose bits are left to drivers:
/// sums of products (cross, dot, products of matrices), interpolation, powers, angles, ...
void check_built_ins(const std::string& kernel, std::span<const std::uint32_t> spirv);

/// The module with every float operation decorated NoContraction: none is merged with the next one.
std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> spirv);

} // namespace taut
