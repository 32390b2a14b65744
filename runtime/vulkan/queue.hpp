#pragma once
// One queue: submissions numbered from 1, each with a fence.

#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <vector>

namespace taut::vulkan {

/// Thread-safe.
class Queue
{
public:
    /// `host_mutex` may be null; it is held around vkQueueSubmit.
    Queue(const VolkDeviceTable& vk, VkDevice device, VkQueue handle, std::mutex* host_mutex, Health& health);
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;
    ~Queue(); ///< nothing may be in flight

    /// Returns the number of the submission. Throws Error{device_lost}.
    std::uint64_t submit(std::span<const VkCommandBuffer> commands);
    std::uint64_t submit(VkCommandBuffer commands) { return submit(std::span(&commands, 1)); }

    /// Waits until submission `number` and all before it are done.
    void wait(std::uint64_t number);
    void wait_all();

    std::uint64_t submissions() const;

private:
    struct Flight
    {
        std::uint64_t number;
        VkFence fence;
    };

    VkFence idle_fence();

    const VolkDeviceTable& vk_;
    VkDevice device_;
    VkQueue handle_;
    std::mutex* host_mutex_;
    Health& health_;
    mutable std::mutex mutex_;
    std::deque<Flight> flights_;
    std::vector<VkFence> idle_;
    std::uint64_t submissions_ = 0;
};

} // namespace taut::vulkan
