#pragma once
// Few large allocations: buffers share blocks of 16 to 64 MiB, larger ones get a block of their own.

#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace taut::vulkan {

/// Part of a block. Given back with Memory::release.
struct Allocation
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize bytes = 0;
    std::byte* mapped = nullptr; ///< first byte for the host, null if it cannot see the memory
};

/// The memory type that `bits` allows, with all of `wanted`, and of those the first with `preferred` as well.
/// -1 if there is none.
int find_memory_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t bits,
                     VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred);

/// Thread-safe. Holds linear resources (buffers) only: images would need bufferImageGranularity.
class Memory
{
public:
    Memory(const VolkDeviceTable& vk, VkDevice device, const VkPhysicalDeviceMemoryProperties& properties,
           Health& health);
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    ~Memory();

    /// Device-local where possible; with `mapped`, coherent memory that stays mapped, of which there is
    /// little on some devices. Throws Error{out_of_memory}.
    Allocation allocate(const VkMemoryRequirements& requirements, bool mapped = false);
    void release(const Allocation& allocation);

    std::uint64_t block_count() const;
    std::uint64_t block_bytes() const; ///< of all blocks, free room and all

private:
    struct Block
    {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize bytes = 0;
        std::uint32_t type = 0;
        std::byte* mapped = nullptr;
        std::map<VkDeviceSize, VkDeviceSize> free; ///< offset -> bytes, never touching each other
    };

    Block& add_block(std::uint32_t type, VkDeviceSize bytes);
    Block& add_mapped_block(std::uint32_t type, VkDeviceSize needed);
    Block& add_shared_block(std::uint32_t type, VkDeviceSize needed);
    static bool take(Block& block, const VkMemoryRequirements& requirements, Allocation& out);

    const VolkDeviceTable& vk_;
    VkDevice device_;
    const VkPhysicalDeviceMemoryProperties& properties_;
    Health& health_;
    mutable std::mutex mutex_;
    std::vector<std::unique_ptr<Block>> blocks_;
};

} // namespace taut::vulkan
