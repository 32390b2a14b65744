#pragma once
// Commands that run once, and the host's way into and out of device memory: one mapped block per device.

#include "taut/runtime/vulkan/queue.hpp"

#include <cstddef>
#include <functional>
#include <mutex>
#include <span>

namespace taut::vulkan {

inline constexpr VkDeviceSize kStagingBytes = VkDeviceSize{8} << 20; ///< of the mapped block

/// Thread-safe. Every call returns after the device has finished.
class Transfer
{
public:
    Transfer(const VolkDeviceTable& vk, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties,
             std::uint32_t queue_family, Queue& queue, Health& health);
    Transfer(const Transfer&) = delete;
    Transfer& operator=(const Transfer&) = delete;
    ~Transfer();

    /// Records with `record`, submits and waits. Ordered after all earlier work of the queue, whose writes
    /// are visible to transfers; the writes of `record` by transfers are visible to the host.
    void run(const std::function<void(VkCommandBuffer)>& record);

    void upload(VkBuffer target, VkDeviceSize offset, std::span<const std::byte> data);
    void download(VkBuffer source, VkDeviceSize offset, std::span<std::byte> data);
    void clear(VkBuffer target); ///< fills with zeros

private:
    void make_staging(const VkPhysicalDeviceMemoryProperties& properties);
    void make_commands(std::uint32_t queue_family);
    void run_locked(const std::function<void(VkCommandBuffer)>& record);
    void destroy();

    const VolkDeviceTable& vk_;
    VkDevice device_;
    Queue& queue_;
    Health& health_;
    std::mutex mutex_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkBuffer staging_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::byte* mapped_ = nullptr;
    bool coherent_ = false;
};

} // namespace taut::vulkan
