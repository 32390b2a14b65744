#pragma once
// Compute pipelines by SPIR-V, and one layout for each number of storage buffers.

#include "taut/runtime/base/kernel_info.hpp"
#include "taut/runtime/device.hpp"
#include "taut/runtime/vulkan/float_controls.hpp"
#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <cstdint>
#include <map>
#include <mutex>
#include <unordered_map>
#include <vector>

namespace taut::vulkan {

struct Pipeline
{
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE; ///< null for a kernel without buffers
};

/// Thread-safe. Pipelines live as long as this object.
class Pipelines
{
public:
    /// Takes no ownership of `cache`. Of `limits`: max_param_bytes is the range of push constants that every
    /// layout has, so that all layouts are compatible with each other; float64 as enabled.
    Pipelines(const VolkDeviceTable& vk, VkDevice device, VkPipelineCache cache, const DeviceLimits& limits,
              const FloatControls& controls, Health& health);
    Pipelines(const Pipelines&) = delete;
    Pipelines& operator=(const Pipelines&) = delete;
    ~Pipelines();

    /// From kernel.spirv_vulkan, or from the text in TAUT_KERNEL_DIR. Throws Error{kernel_compilation} for
    /// that text, Error{unsupported} for 64-bit floats on a device without, Error{bad_input} for no SPIR-V.
    Pipeline get(const KernelInfo& kernel);

private:
    struct Layout
    {
        VkDescriptorSetLayout set = VK_NULL_HANDLE;
        VkPipelineLayout pipeline = VK_NULL_HANDLE;
    };

    struct Entry
    {
        std::vector<std::uint32_t> spirv; ///< kept: kernels come and go, their addresses mean nothing
        Pipeline pipeline;
    };

    const Layout& layout_for(std::uint32_t binding_count);
    Pipeline make(const KernelInfo& kernel, std::span<const std::uint32_t> spirv);

    const VolkDeviceTable& vk_;
    VkDevice device_;
    VkPipelineCache cache_;
    std::uint32_t push_bytes_;
    bool float64_;
    FloatControls controls_;
    Health& health_;
    std::mutex mutex_;
    std::map<std::uint32_t, Layout> layouts_;
    std::unordered_multimap<std::size_t, Entry> entries_;
};

} // namespace taut::vulkan
