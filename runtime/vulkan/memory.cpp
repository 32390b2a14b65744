#include "taut/runtime/vulkan/memory.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>
#include <cassert>
#include <string>

namespace taut::vulkan {
namespace {

constexpr VkDeviceSize kFirstBlock = VkDeviceSize{16} << 20;
constexpr VkDeviceSize kMappedBlock = VkDeviceSize{1} << 20;
constexpr VkDeviceSize kLargestBlock = VkDeviceSize{64} << 20;

VkDeviceSize align_up(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

} // namespace

int find_memory_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t bits,
                     VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred)
{
    int fallback = -1;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((bits & (1u << i)) == 0 || (flags & wanted) != wanted)
            continue;
        if ((flags & preferred) == preferred)
            return static_cast<int>(i);
        if (fallback < 0)
            fallback = static_cast<int>(i);
    }
    return fallback;
}

Memory::Memory(const VolkDeviceTable& vk, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties,
               Health& health)
    : vk_(vk),
      device_(device),
      properties_(properties),
      health_(health)
{}

Memory::~Memory()
{
    for (const auto& block : blocks_)
        vk_.vkFreeMemory(device_, block->memory, nullptr);
}

Memory::Block& Memory::add_block(std::uint32_t type, VkDeviceSize bytes)
{
    const VkDeviceSize heap = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    if (bytes > heap)
        throw Error(ErrorCode::out_of_memory, "a Vulkan allocation of " + std::to_string(bytes) +
                                                  " bytes does not fit the device's memory of " +
                                                  std::to_string(heap) + " bytes; use smaller buffers");
    auto info = start<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    auto block = std::make_unique<Block>();
    const VkResult result = vk_.vkAllocateMemory(device_, &info, nullptr, &block->memory);
    if (result != VK_SUCCESS)
        health_.check(result, ("vkAllocateMemory of " + std::to_string(bytes) + " bytes").c_str());
    block->bytes = bytes;
    block->type = type;
    block->free.emplace(0, bytes);
    return *blocks_.emplace_back(std::move(block));
}

Memory::Block& Memory::add_shared_block(std::uint32_t type, VkDeviceSize needed)
{
    // By what is held, not by what once was: what a world is given does not depend on those before it.
    VkDeviceSize bytes = kFirstBlock;
    for (const auto& block : blocks_)
        if (block->type == type && !block->mapped && block->bytes <= kLargestBlock)
            bytes = std::min(kLargestBlock, bytes * 2);
    try
    {
        return add_block(type, std::max(bytes, align_up(needed, kFirstBlock)));
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::out_of_memory)
            throw;
        return add_block(type, needed); // an almost full device may still hold just this
    }
}

bool Memory::take(Block& block, const VkMemoryRequirements& requirements, Allocation& out)
{
    for (auto it = block.free.begin(); it != block.free.end(); ++it)
    {
        const auto [start, bytes] = *it;
        const VkDeviceSize offset = align_up(start, requirements.alignment);
        if (offset + requirements.size > start + bytes)
            continue;
        block.free.erase(it);
        if (offset > start)
            block.free.emplace(start, offset - start);
        const VkDeviceSize end = offset + requirements.size;
        if (end < start + bytes)
            block.free.emplace(end, start + bytes - end);
        out = {block.memory, offset, requirements.size, block.mapped ? block.mapped + offset : nullptr};
        return true;
    }
    return false;
}

Memory::Block& Memory::add_mapped_block(std::uint32_t type, VkDeviceSize needed)
{
    Block& block = add_block(type, std::max(kMappedBlock, needed));
    void* address = nullptr;
    health_.check(vk_.vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &address), "vkMapMemory");
    block.mapped = static_cast<std::byte*>(address);
    return block;
}

Allocation Memory::allocate(const VkMemoryRequirements& requirements, bool mapped)
{
    const std::lock_guard lock(mutex_);
    const VkMemoryPropertyFlags wanted =
        mapped ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
    const int type = find_memory_type(properties_, requirements.memoryTypeBits, wanted,
                                      VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type < 0)
        throw Error(ErrorCode::out_of_memory, "the Vulkan device has no memory type for storage buffers");
    Allocation out;
    for (const auto& block : blocks_)
        if (block->type == static_cast<std::uint32_t>(type) && (block->mapped != nullptr) == mapped &&
            take(*block, requirements, out))
            return out;
    // Beyond half a block, sharing would waste more than it saves.
    const auto type_index = static_cast<std::uint32_t>(type);
    Block& block = mapped ? add_mapped_block(type_index, requirements.size)
                   : requirements.size > kLargestBlock / 2 ? add_block(type_index, requirements.size)
                                                           : add_shared_block(type_index, requirements.size);
    [[maybe_unused]] const bool taken = take(block, requirements, out);
    assert(taken);
    return out;
}

void Memory::release(const Allocation& allocation)
{
    const std::lock_guard lock(mutex_);
    const auto owner = std::find_if(blocks_.begin(), blocks_.end(),
                                    [&](const auto& block) { return block->memory == allocation.memory; });
    assert(owner != blocks_.end());
    auto& free = (*owner)->free;
    auto it = free.emplace(allocation.offset, allocation.bytes).first;
    if (const auto next = std::next(it); next != free.end() && it->first + it->second == next->first)
    {
        it->second += next->second;
        free.erase(next);
    }
    if (it != free.begin())
        if (const auto previous = std::prev(it); previous->first + previous->second == it->first)
        {
            previous->second += it->second;
            it = free.erase(it);
            it = previous;
        }
    if (it->second != (*owner)->bytes)
        return;
    vk_.vkFreeMemory(device_, allocation.memory, nullptr);
    blocks_.erase(owner);
}

std::uint64_t Memory::block_count() const
{
    const std::lock_guard lock(mutex_);
    return blocks_.size();
}

std::uint64_t Memory::block_bytes() const
{
    const std::lock_guard lock(mutex_);
    std::uint64_t sum = 0;
    for (const std::unique_ptr<Block>& block : blocks_)
        sum += block->bytes;
    return sum;
}

} // namespace taut::vulkan
