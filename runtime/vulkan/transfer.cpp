#include "taut/runtime/vulkan/transfer.hpp"

#include "taut/runtime/vulkan/memory.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>
#include <cstring>

namespace taut::vulkan {
Transfer::Transfer(const VolkDeviceTable& vk, VkDevice device,
                   const VkPhysicalDeviceMemoryProperties& properties, std::uint32_t queue_family,
                   Queue& queue, Health& health)
    : vk_(vk),
      device_(device),
      queue_(queue),
      health_(health)
{
    try
    {
        make_staging(properties);
        make_commands(queue_family);
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

Transfer::~Transfer() { destroy(); }

void Transfer::destroy()
{
    vk_.vkDestroyCommandPool(device_, pool_, nullptr);
    vk_.vkDestroyBuffer(device_, staging_, nullptr);
    vk_.vkFreeMemory(device_, memory_, nullptr);
}

void Transfer::make_staging(const VkPhysicalDeviceMemoryProperties& properties)
{
    auto info = start<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = kStagingBytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    health_.check(vk_.vkCreateBuffer(device_, &info, nullptr, &staging_), "vkCreateBuffer");
    VkMemoryRequirements needs = {};
    vk_.vkGetBufferMemoryRequirements(device_, staging_, &needs);
    // Reading uncached memory costs many times what a flush does, so cached comes before coherent.
    int type = find_memory_type(properties, needs.memoryTypeBits,
                                VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (type < 0)
        type = find_memory_type(properties, needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                                VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    if (type < 0)
        throw Error(ErrorCode::unsupported, "the Vulkan device offers no memory that the host can map");
    auto memory = start<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    memory.allocationSize = needs.size;
    memory.memoryTypeIndex = static_cast<std::uint32_t>(type);
    health_.check(vk_.vkAllocateMemory(device_, &memory, nullptr, &memory_), "vkAllocateMemory");
    health_.check(vk_.vkBindBufferMemory(device_, staging_, memory_, 0), "vkBindBufferMemory");
    void* mapped = nullptr;
    health_.check(vk_.vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    mapped_ = static_cast<std::byte*>(mapped);
    coherent_ = (properties.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_COHERENT_BIT) != 0;
}

void Transfer::make_commands(std::uint32_t queue_family)
{
    auto pool = start<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queue_family;
    health_.check(vk_.vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
    auto info = start<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool_;
    info.commandBufferCount = 1;
    health_.check(vk_.vkAllocateCommandBuffers(device_, &info, &commands_), "vkAllocateCommandBuffers");
}

void Transfer::run(const std::function<void(VkCommandBuffer)>& record)
{
    const std::lock_guard lock(mutex_);
    run_locked(record);
}

void Transfer::run_locked(const std::function<void(VkCommandBuffer)>& record)
{
    health_.require_alive();
    health_.check(vk_.vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
    auto begin = start<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    health_.check(vk_.vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    auto before = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    before.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    before.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &before, 0, nullptr, 0, nullptr);
    record(commands_);
    auto after = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    after.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    after.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vk_.vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &after, 0, nullptr, 0, nullptr);
    health_.check(vk_.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    queue_.wait(queue_.submit(commands_));
}

void Transfer::upload(VkBuffer target, VkDeviceSize offset, std::span<const std::byte> data)
{
    const std::lock_guard lock(mutex_);
    health_.require_alive();
    const VkMappedMemoryRange whole = {VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, memory_, 0,
                                       VK_WHOLE_SIZE};
    for (std::size_t done = 0; done < data.size();)
    {
        const std::size_t bytes = std::min<std::size_t>(data.size() - done, kStagingBytes);
        std::memcpy(mapped_, data.data() + done, bytes);
        if (!coherent_)
            health_.check(vk_.vkFlushMappedMemoryRanges(device_, 1, &whole), "vkFlushMappedMemoryRanges");
        const VkBufferCopy region = {0, offset + done, bytes};
        run_locked(
            [&](VkCommandBuffer commands) { vk_.vkCmdCopyBuffer(commands, staging_, target, 1, &region); });
        done += bytes;
    }
}

void Transfer::download(VkBuffer source, VkDeviceSize offset, std::span<std::byte> data)
{
    const std::lock_guard lock(mutex_);
    health_.require_alive();
    const VkMappedMemoryRange whole = {VK_STRUCTURE_TYPE_MAPPED_MEMORY_RANGE, nullptr, memory_, 0,
                                       VK_WHOLE_SIZE};
    for (std::size_t done = 0; done < data.size();)
    {
        const std::size_t bytes = std::min<std::size_t>(data.size() - done, kStagingBytes);
        const VkBufferCopy region = {offset + done, 0, bytes};
        run_locked(
            [&](VkCommandBuffer commands) { vk_.vkCmdCopyBuffer(commands, source, staging_, 1, &region); });
        if (!coherent_)
            health_.check(vk_.vkInvalidateMappedMemoryRanges(device_, 1, &whole),
                          "vkInvalidateMappedMemoryRanges");
        std::memcpy(data.data() + done, mapped_, bytes);
        done += bytes;
    }
}

void Transfer::clear(VkBuffer target)
{
    run([&](VkCommandBuffer commands) { vk_.vkCmdFillBuffer(commands, target, 0, VK_WHOLE_SIZE, 0); });
}

} // namespace taut::vulkan
