#pragma once
// For engines that have a Vulkan device of their own: simulate on it and draw from the very buffers.

#include "taut/runtime/device.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace taut {

/// What a host must enable before it hands its device over.
struct VulkanRequirements
{
    std::uint32_t api_version = VK_API_VERSION_1_1;  ///< of the instance and of the device, at least
    VkQueueFlags queue_flags = VK_QUEUE_COMPUTE_BIT; ///< of the queue's family, at least
    VkPhysicalDeviceFeatures features = {};          ///< each VK_TRUE must be enabled at device creation
    std::vector<const char*> instance_extensions;    ///< none so far
    std::vector<const char*> device_extensions;      ///< none so far
};

/// For recordings in this precision. float64 needs shaderFloat64.
VulkanRequirements vulkan_requirements(Precision precision = Precision::float32);

/// A host's own device. Every handle stays the host's: none is destroyed here, and all must outlive the
/// Device, its buffers and its recordings.
struct VulkanContext
{
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    std::uint32_t api_version = 0; ///< VkApplicationInfo::apiVersion of the instance
    bool shader_float64 = false;   ///< true if the device was created with shaderFloat64
    /// Held around every use of `queue`. Null: the host uses the queue only while no call into this
    /// device is running (Vulkan asks for that of every queue).
    std::mutex* queue_mutex = nullptr;
    /// Used for all pipelines if given; never destroyed and not written to a file.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
};

/// A Device on the host's handles. On a software driver its threads are the host's, too: where it keeps
/// denormals (Mesa 22), results with them differ from other executors', unless the host started it within a
/// FlushDenormals (taut/runtime/base/flush_denormals.hpp). Throws Error{bad_input} for a null handle or a
/// queue family that does not exist, Error{unsupported} for a family without compute, a version below 1.1, or
/// a claimed feature that the physical device does not have.
std::shared_ptr<Device> adopt(const VulkanContext& context);

/// Records all dispatches of `recording`, with the barriers between them, into a primary command buffer in
/// the recording state and outside a render pass. A barrier stands before (all earlier commands and host
/// writes -> compute) and after (compute -> all later commands and host reads), so that the caller may copy
/// into or draw from the buffers around it in the same queue without barriers of its own.
/// The caller submits to the queue that this device uses (or orders its own queue after it by a semaphore)
/// and keeps `recording` alive until the work is done; Device::wait does not know of such work, Device::read
/// on the same queue comes after it. Compute pipeline, descriptor set 0 and push constants of `commands` are
/// changed. `writes` stand in the commands themselves, before the dispatches: what the host hands over for
/// this submission, whatever it hands over for others that are in flight. Throws Error{unsupported} for a
/// recording of another executor.
void record_into(Recording& recording, VkCommandBuffer commands, std::span<const BufferWrite> writes = {});

/// The VkBuffer behind a buffer, to draw from it without a copy (vertex, index, storage, indirect and
/// transfer usage). `offset`, if given, receives the byte at which the buffer starts in it. Throws
/// Error{unsupported} for a buffer of another executor. The handle lives as long as the Buffer.
VkBuffer vulkan_buffer(const BufferPtr& buffer, VkDeviceSize* offset = nullptr);

} // namespace taut
