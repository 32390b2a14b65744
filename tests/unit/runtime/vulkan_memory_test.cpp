// Memory of the Vulkan executor: what goes in comes out, few allocations, sizes that do not fit.

#include "vulkan_support.hpp"

#include "taut/runtime/vulkan/context.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::vulkan_test;

namespace {

std::vector<std::byte> pattern(std::size_t bytes, unsigned seed)
{
    std::vector<std::byte> out(bytes);
    std::uint32_t state = seed * 2654435761u + 1;
    for (std::byte& b : out)
    {
        state = state * 1664525u + 1013904223u;
        b = static_cast<std::byte>(state >> 24);
    }
    return out;
}

} // namespace

TEST_CASE("new Vulkan memory is zero, also where others wrote before")
{
    TAUT_VULKAN_DEVICE(device);
    for (int round = 0; round < 2; ++round)
    {
        const BufferPtr buffer = device->make_buffer(10'001, "zero");
        const std::vector<std::byte> found = device->read<std::byte>(buffer, 10'001);
        CHECK(std::all_of(found.begin(), found.end(), [](std::byte b) { return b == std::byte{0}; }));
        device->write<std::byte>(buffer, std::vector<std::byte>(10'001, std::byte{0xFF}));
    }
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("bytes come back from a Vulkan device as they went, at any offset and size")
{
    TAUT_VULKAN_DEVICE(device);
    const std::size_t total = (std::size_t{20} << 20) + 5; // more than two blocks of staging
    const BufferPtr buffer = device->make_buffer(total, "bytes");
    std::vector<std::byte> expected(total, std::byte{0});
    const auto put = [&](std::size_t offset, std::size_t bytes, unsigned seed) {
        const std::vector<std::byte> data = pattern(bytes, seed);
        device->write<std::byte>(buffer, data, offset);
        std::copy(data.begin(), data.end(), expected.begin() + static_cast<std::ptrdiff_t>(offset));
    };
    put(3, total - 9, 1);
    put(7, 13, 2);
    put(1, 1, 3);
    put(total - 1, 1, 4);
    put((std::size_t{8} << 20) - 3, 7, 5);
    CHECK(device->read<std::byte>(buffer, total) == expected);
    const std::vector<std::byte> middle = device->read<std::byte>(buffer, 1021, 77'777);
    CHECK(std::equal(middle.begin(), middle.end(), expected.begin() + 77'777));
    device->write<std::byte>(buffer, std::span<const std::byte>{}, total);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a transfer beyond the end of a Vulkan buffer is refused")
{
    TAUT_VULKAN_DEVICE(device);
    const BufferPtr buffer = device->make_buffer(100, "short");
    const std::vector<std::byte> data(50);
    CHECK(refusal([&] { device->write<std::byte>(buffer, data, 51); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->read<std::byte>(buffer, 1, 100); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->write<std::byte>(buffer, data, ~std::uint64_t{0} - 10); }).code ==
          ErrorCode::bad_input);
    CHECK(contains(refusal([&] { device->write<std::byte>(buffer, data, 51); }).text, "100"));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("many small Vulkan buffers share few allocations and give them back")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint64_t blocks_before = device->counters().memory_blocks;
    std::vector<BufferPtr> buffers;
    std::uint64_t sum = 0;
    for (unsigned i = 0; i < 60; ++i)
    {
        const std::uint64_t bytes = 200'000 + 12'345 * (i % 7);
        sum += bytes;
        buffers.push_back(device->make_buffer(bytes, "small"));
        device->write<std::byte>(buffers.back(), pattern(bytes, i));
    }
    CHECK(device->counters().bytes_allocated == sum);
    CHECK(device->counters().bytes_reserved >= sum + (8u << 20)); // and the staging room
    CHECK(device->counters().bytes_reserved < sum + (256u << 20));
    CHECK(device->counters().memory_blocks <= blocks_before + 2);
    for (std::size_t i = 0; i < buffers.size(); i += 2)
        buffers[i].reset();
    for (std::size_t i = 0; i < buffers.size(); i += 2)
    {
        buffers[i] = device->make_buffer(150'001, "again");
        device->write<std::byte>(buffers[i], pattern(150'001, static_cast<unsigned>(i) + 100));
    }
    CHECK(device->counters().memory_blocks <= blocks_before + 2);
    for (unsigned i = 0; i < buffers.size(); ++i)
        CHECK(device->read<std::byte>(buffers[i], buffers[i]->bytes()) ==
              pattern(buffers[i]->bytes(), i % 2 == 0 ? i + 100 : i));
    const BufferPtr large = device->make_buffer(std::uint64_t{40} << 20, "large");
    CHECK(device->counters().memory_blocks <= blocks_before + 3);
    buffers.clear();
    CHECK(device->counters().bytes_allocated == large->bytes());
    CHECK(device->counters().memory_blocks == blocks_before + 1);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("sizes that no Vulkan binding can hold are refused with both numbers")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint64_t most = device->limits().max_buffer_bytes;
    const Refusal refused = refusal([&] { device->make_buffer(most + 1, "huge"); });
    CHECK(refused.code == ErrorCode::limit);
    CHECK(contains(refused.text, "huge"));
    CHECK(contains(refused.text, std::to_string(most + 1)));
    CHECK(contains(refused.text, std::to_string(most)));
    CHECK(refusal([&] { device->make_buffer(0, "none"); }).code == ErrorCode::bad_input);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a binding at an offset that Vulkan cannot bind is refused")
{
    TAUT_VULKAN_DEVICE(device);
    if (device->limits().offset_alignment < 8)
        return;
    const BufferPtr x = device->make_buffer(1024, "x");
    const Refusal refused = refusal([&] {
        Recorder recorder(device);
        recorder.dispatch(affine(), {{x, 4, 64}}, AffineParams{16, 1, 0}, 16);
        recorder.finish();
    });
    REQUIRE(refused.code);
    CHECK(contains(refused.text, std::to_string(device->limits().offset_alignment)));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a Vulkan device without room says how much was asked for, and goes on")
{
    TAUT_VULKAN_DEVICE(device);
    vulkan::Context& context = *vulkan::context_of(*device);
    const PFN_vkAllocateMemory allocate = context.vk.vkAllocateMemory;
    context.vk.vkAllocateMemory = [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                                     VkDeviceMemory*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
    for (const std::uint64_t bytes : {std::uint64_t{4096}, std::uint64_t{50} << 20})
    {
        const Refusal refused = refusal([&] { device->make_buffer(bytes, "x"); });
        CHECK(refused.code == ErrorCode::out_of_memory);
        CHECK(contains(refused.text, std::to_string(bytes)));
        CHECK(contains(refused.text, "VK_ERROR_OUT_OF_DEVICE_MEMORY"));
    }
    CHECK(device->counters().bytes_allocated == 0);
    context.vk.vkAllocateMemory = allocate;
    CHECK(device->read<float>(device->make_buffer(4096, "x"), 1) == std::vector{0.0f});
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("an almost full Vulkan device still gives a small buffer its own small block")
{
    TAUT_VULKAN_DEVICE(device);
    vulkan::Context& context = *vulkan::context_of(*device);
    VkPhysicalDeviceMemoryProperties small = context.physical.memory;
    for (VkMemoryHeap& heap : small.memoryHeaps)
        heap.size = 1 << 20;
    vulkan::Memory memory(context.vk, context.device, small, context.health);
    const std::uint32_t any = (1u << small.memoryTypeCount) - 1;
    const vulkan::Allocation part = memory.allocate({1000, 64, any});
    CHECK(part.bytes == 1000);
    CHECK(memory.block_count() == 1);
    const Refusal refused = refusal([&] { memory.allocate({(1 << 20) + 1, 64, any}); });
    CHECK(refused.code == ErrorCode::out_of_memory);
    CHECK(contains(refused.text, "1048577"));
    memory.release(part);
    CHECK(memory.block_count() == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("what the driver is asked for does not depend on what was given back before")
{
    TAUT_VULKAN_DEVICE(device);
    vulkan::Context& context = *vulkan::context_of(*device);
    const VkPhysicalDeviceMemoryProperties& properties = context.physical.memory;
    vulkan::Memory memory(context.vk, context.device, properties, context.health);
    const std::uint32_t any = (1u << properties.memoryTypeCount) - 1;
    const auto held_by = [&](std::size_t count) { // buffers of 10 MiB, all at once
        std::vector<vulkan::Allocation> parts;
        for (std::size_t i = 0; i < count; ++i)
            parts.push_back(memory.allocate({VkDeviceSize{10} << 20, 64, any}));
        const std::uint64_t bytes = memory.block_bytes();
        for (const vulkan::Allocation& part : parts)
            memory.release(part);
        return bytes;
    };
    const std::uint64_t one = held_by(1);
    CHECK(one < std::uint64_t{20} << 20);
    CHECK(held_by(6) > 3 * one);
    CHECK(held_by(1) == one);
    CHECK(memory.block_count() == 0);
    CHECK_NOTHING_SAID(device);
}
