#pragma once
// How a device rounds, that denormals are zero and that signed zeros are kept: asked of each kernel, where
// the device lets it be asked for, so that bits are those of the native executor.
//
// Based on: Vulkan Specification, VkPhysicalDeviceFloatControlsProperties (core in 1.2, before that
//   VK_KHR_shader_float_controls); SPV_KHR_float_controls.
// Departures: none.

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

namespace taut::vulkan {

/// What may be asked for in a kernel, for floats of 32 and of 64 bits.
struct FloatControls
{
    struct Width
    {
        bool rounds_to_even = false;      ///< RoundingModeRTE
        bool flushes_denormals = false;   ///< DenormFlushToZero
        bool keeps_zeros_and_nan = false; ///< SignedZeroInfNanPreserve
    };
    Width float32, float64;
};

/// From the properties of a device. What cannot be set for one width alone is set for none, unless both have
/// it: a kernel of doubles asks for both.
FloatControls float_controls(const VkPhysicalDeviceFloatControlsProperties& properties);

/// The module with the execution modes that `controls` allows. `float64`: whether it declares Float64.
std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> spirv,
                                               const FloatControls& controls, bool float64);

} // namespace taut::vulkan
