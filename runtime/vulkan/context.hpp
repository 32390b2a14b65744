#pragma once
// Internal to runtime/vulkan: one VkDevice and everything that hangs on it. The executor is built on this,
// and so is whatever draws with a graphics pipeline: device, function table, queue, memory, commands that run
// once.

#include "taut/runtime/device.hpp"
#include "taut/runtime/vulkan/instance.hpp"
#include "taut/runtime/vulkan/interop.hpp"
#include "taut/runtime/vulkan/memory.hpp"
#include "taut/runtime/vulkan/pipelines.hpp"
#include "taut/runtime/vulkan/queue.hpp"
#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/transfer.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <atomic>
#include <memory>
#include <string>

namespace taut::vulkan {

/// Buffers, recordings and the Device share one Context; the last of them closes the device.
class Context
{
public:
    /// Creates a VkDevice. `cache_path` empty: no file is touched.
    static std::shared_ptr<Context> create(std::shared_ptr<Instance> instance, PhysicalDevice physical,
                                           std::string cache_path);
    /// On a host's device, whose handles were checked.
    static std::shared_ptr<Context> borrow(std::shared_ptr<Instance> instance, PhysicalDevice physical,
                                           const VulkanContext& host);

    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    ~Context();

    /// Names an object in validation messages; does nothing without validation.
    void name_object(VkObjectType type, std::uint64_t object, std::string_view name) const;

    /// Writes the pipeline cache where the options said, if they did.
    void save_cache() noexcept;

    std::shared_ptr<Instance> instance;
    PhysicalDevice physical; ///< queue_family and family are those of `queue`
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue_handle = VK_NULL_HANDLE; ///< submit through `queue`
    VolkDeviceTable vk = {};
    Health health;

    std::unique_ptr<Memory> memory;
    std::unique_ptr<Queue> queue;
    std::unique_ptr<Transfer> transfer;
    std::unique_ptr<Pipelines> pipelines;
    VkPipelineCache cache = VK_NULL_HANDLE;

    std::atomic<std::uint64_t> dispatches = 0;
    std::atomic<std::uint64_t> barriers = 0;
    std::atomic<std::uint64_t> buffer_bytes = 0;

private:
    void open_device();
    void build(VkQueue handle, std::mutex* host_mutex);
    void open_cache();

    bool owns_device_ = false;
    bool owns_cache_ = false;
    std::string cache_path_;
};

/// A buffer of its own VkBuffer, in a shared block of memory.
class VulkanBuffer final : public Buffer
{
public:
    VulkanBuffer(std::shared_ptr<Context> context, std::uint64_t bytes, std::string_view label,
                 BufferUse use);
    ~VulkanBuffer() override;

    std::shared_ptr<Context> context;
    VkBuffer handle = VK_NULL_HANDLE;

    /// First byte in the host's address space; null for buffers that only the device touches.
    std::byte* mapped() const { return allocation_.mapped; }

private:
    void destroy();
    Allocation allocation_;
};

/// Throws Error{unsupported} when the device or buffer belongs to another executor.
std::shared_ptr<Context> context_of(const Device& device);
VulkanBuffer& vulkan_buffer_of(const BufferPtr& buffer);

/// The Device on a context.
std::shared_ptr<Device> make_device(std::shared_ptr<Context> context, DeviceInfo info);

} // namespace taut::vulkan
