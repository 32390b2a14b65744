#include "taut/runtime/vulkan/queue.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <limits>

namespace taut::vulkan {

Queue::Queue(const VolkDeviceTable& vk, VkDevice device, VkQueue handle, std::mutex* host_mutex,
             Health& health)
    : vk_(vk),
      device_(device),
      handle_(handle),
      host_mutex_(host_mutex),
      health_(health)
{}

Queue::~Queue()
{
    for (const Flight& flight : flights_)
        vk_.vkDestroyFence(device_, flight.fence, nullptr);
    for (const VkFence fence : idle_)
        vk_.vkDestroyFence(device_, fence, nullptr);
}

VkFence Queue::idle_fence()
{
    if (idle_.empty())
    {
        const auto info = start<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
        VkFence fence = VK_NULL_HANDLE;
        health_.check(vk_.vkCreateFence(device_, &info, nullptr, &fence), "vkCreateFence");
        idle_.push_back(fence);
    }
    return idle_.back();
}

std::uint64_t Queue::submit(std::span<const VkCommandBuffer> commands)
{
    const std::lock_guard lock(mutex_);
    health_.require_alive();
    const VkFence fence = idle_fence();
    auto info = start<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    info.commandBufferCount = static_cast<std::uint32_t>(commands.size());
    info.pCommandBuffers = commands.data();
    {
        std::unique_lock<std::mutex> host;
        if (host_mutex_ != nullptr)
            host = std::unique_lock(*host_mutex_);
        health_.check(vk_.vkQueueSubmit(handle_, 1, &info, fence), "vkQueueSubmit");
    }
    idle_.pop_back();
    flights_.push_back({++submissions_, fence});
    return submissions_;
}

void Queue::wait(std::uint64_t number)
{
    const std::lock_guard lock(mutex_);
    health_.require_alive();
    std::vector<VkFence> fences;
    for (const Flight& flight : flights_)
        if (flight.number <= number)
            fences.push_back(flight.fence);
    if (fences.empty())
        return;
    const auto count = static_cast<std::uint32_t>(fences.size());
    constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
    health_.check(vk_.vkWaitForFences(device_, count, fences.data(), VK_TRUE, forever), "vkWaitForFences");
    health_.check(vk_.vkResetFences(device_, count, fences.data()), "vkResetFences");
    flights_.erase(flights_.begin(), flights_.begin() + count);
    idle_.insert(idle_.end(), fences.begin(), fences.end());
}

void Queue::wait_all() { wait(std::numeric_limits<std::uint64_t>::max()); }

std::uint64_t Queue::submissions() const
{
    const std::lock_guard lock(mutex_);
    return submissions_;
}

} // namespace taut::vulkan
