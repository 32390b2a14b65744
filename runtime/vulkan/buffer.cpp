#include "taut/runtime/vulkan/context.hpp"
#include "taut/runtime/vulkan/structs.hpp"

namespace taut::vulkan {
namespace {

// vkCmdFillBuffer works in words of 4 bytes.
std::uint64_t round_up(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                                      VK_BUFFER_USAGE_INDEX_BUFFER_BIT;

} // namespace

VulkanBuffer::VulkanBuffer(std::shared_ptr<Context> owner, std::uint64_t bytes, std::string_view label,
                           BufferUse use)
    : Buffer(bytes),
      context(std::move(owner))
{
    context->health.require_alive();
    auto info = start<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = round_up(bytes);
    info.usage = kUsage;
    const VolkDeviceTable& vk = context->vk;
    context->health.check(vk.vkCreateBuffer(context->device, &info, nullptr, &handle), "vkCreateBuffer");
    try
    {
        VkMemoryRequirements needs = {};
        vk.vkGetBufferMemoryRequirements(context->device, handle, &needs);
        allocation_ = context->memory->allocate(needs, use == BufferUse::host_written);
        context->health.check(
            vk.vkBindBufferMemory(context->device, handle, allocation_.memory, allocation_.offset),
            "vkBindBufferMemory");
        context->name_object(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(handle), label);
        context->transfer->clear(handle);
    }
    catch (...)
    {
        destroy();
        throw;
    }
    context->buffer_bytes += bytes;
}

VulkanBuffer::~VulkanBuffer()
{
    destroy();
    context->buffer_bytes -= bytes();
}

void VulkanBuffer::destroy()
{
    context->vk.vkDestroyBuffer(context->device, handle, nullptr);
    if (allocation_.memory != VK_NULL_HANDLE)
        context->memory->release(allocation_);
}

VulkanBuffer& vulkan_buffer_of(const BufferPtr& buffer)
{
    auto* const own = dynamic_cast<VulkanBuffer*>(buffer.get());
    if (own == nullptr)
        throw Error(ErrorCode::unsupported, buffer ? "the buffer does not belong to a Vulkan device"
                                                   : "the buffer is null; make one with Device::make_buffer");
    return *own;
}

} // namespace taut::vulkan
