// What the Vulkan executor records and submits: replays, barriers, descriptor sets, timestamps.

#include "vulkan_support.hpp"

#include "taut/runtime/vulkan/context.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::vulkan_test;

TEST_CASE("a Vulkan replay is one submission, whatever the number of passes")
{
    TAUT_VULKAN_DEVICE(device);
    const BufferPtr x = device->make_buffer(256, "x");
    for (const int passes : {1, 10, 500})
    {
        const auto recording = affine_chain(device, x, 64, passes);
        CHECK(recording->barrier_count() == static_cast<std::size_t>(passes - 1));
        for (int replay = 0; replay < 3; ++replay)
        {
            const DeviceCounters before = device->counters();
            recording->replay();
            const DeviceCounters after = device->counters();
            CHECK(after.submissions == before.submissions + 1);
            CHECK(after.dispatches == before.dispatches + static_cast<std::uint64_t>(passes));
            CHECK(after.barriers == before.barriers + static_cast<std::uint64_t>(passes - 1));
        }
        const std::uint64_t submissions = device->counters().submissions;
        device->wait();
        CHECK(device->counters().submissions == submissions);
    }
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("Vulkan replays that were not waited for run one after another")
{
    TAUT_VULKAN_DEVICE(device);
    const BufferPtr x = device->make_buffer(4 * 5000, "x");
    const auto recording = affine_chain(device, x, 5000, 1);
    for (int i = 0; i < 12; ++i)
        recording->replay();
    const std::vector<float> found = device->read<float>(x, 5000);
    CHECK(std::all_of(found.begin(), found.end(), [](float v) { return v == 4095.0f; })); // 2^12 - 1
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a Vulkan recording may be dropped while it runs, and outlive its device")
{
    std::shared_ptr<Device> device = open_here();
    if (!device)
        return;
    const BufferPtr x = device->make_buffer(4 * 50'000, "x");
    affine_chain(device, x, 50'000, 20)->replay();
    const auto recording = affine_chain(device, x, 50'000, 1);
    device->wait();
    const std::shared_ptr<vulkan::ValidationLog> log = vulkan::context_of(*device)->instance->log;
    device.reset();
    recording->replay();
    CHECK(log->count() == 0);
}

TEST_CASE("timestamps are positive, in order of the list, and leave the fast replay as it was")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint32_t n = 20'000;
    const BufferPtr x = device->make_buffer(4 * n, "x");
    const BufferPtr tiny = device->make_buffer(256, "tiny");
    Recorder recorder(device);
    recorder.dispatch(affine(), {x}, AffineParams{n, 2, 1}, n);
    recorder.dispatch(affine(), {tiny}, AffineParams{1, 2, 1}, 1);
    recorder.dispatch(affine(), {x}, AffineParams{n, 2, 1}, n);
    const auto recording = recorder.finish();
    const std::vector<DispatchTime> times = recording->replay_timed();
    REQUIRE(times.size() == 3);
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        CHECK(times[i].dispatch == i);
        CHECK(times[i].nanoseconds > 0);
        CHECK(times[i].nanoseconds < 1e10);
    }
    recording->replay();
    recording->replay_timed();
    CHECK(device->read<float>(x, n) == std::vector<float>(n, 63.0f)); // 2^6 - 1
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a list longer than one query pool is timed whole")
{
    TAUT_VULKAN_DEVICE(device);
    const BufferPtr x = device->make_buffer(256, "x");
    const int passes = 5000; // 10,000 timestamps
    Recorder recorder(device);
    for (int i = 0; i < passes; ++i)
        recorder.dispatch(affine(), {x}, AffineParams{1, 1, 1}, 1);
    const std::vector<DispatchTime> times = recorder.finish()->replay_timed();
    REQUIRE(times.size() == static_cast<std::size_t>(passes));
    CHECK(std::all_of(times.begin(), times.end(), [](const DispatchTime& t) { return t.nanoseconds > 0; }));
    CHECK(device->read<float>(x, 1) == std::vector{static_cast<float>(passes)});
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("an empty Vulkan recording is one submission of nothing")
{
    TAUT_VULKAN_DEVICE(device);
    const auto recording = Recorder(device).finish();
    recording->replay();
    CHECK(recording->replay_timed().empty());
    CHECK(device->counters().submissions == 2);
    CHECK(device->counters().dispatches == 0);
    CHECK_NOTHING_SAID(device);
}

namespace {

/// Writes down what is recorded: lavapipe runs dispatches one by one and would never show a missing barrier.
struct Script
{
    struct Barrier
    {
        VkPipelineStageFlags from, to;
        VkAccessFlags written, used;
    };

    static inline std::string order; ///< B barrier, D dispatch, I indirect dispatch
    static inline std::vector<Barrier> barriers;
    static inline int pipelines = 0, sets = 0;

    static VKAPI_ATTR void VKAPI_CALL barrier(VkCommandBuffer, VkPipelineStageFlags from,
                                              VkPipelineStageFlags to, VkDependencyFlags, std::uint32_t,
                                              const VkMemoryBarrier* memory, std::uint32_t,
                                              const VkBufferMemoryBarrier*, std::uint32_t,
                                              const VkImageMemoryBarrier*)
    {
        order += 'B';
        barriers.push_back({from, to, memory->srcAccessMask, memory->dstAccessMask});
    }

    explicit Script(VolkDeviceTable& vk)
    {
        order.clear();
        barriers.clear();
        pipelines = sets = 0;
        vk.vkCmdPipelineBarrier = barrier;
        vk.vkCmdDispatch = [](VkCommandBuffer, std::uint32_t, std::uint32_t, std::uint32_t) { order += 'D'; };
        vk.vkCmdDispatchIndirect = [](VkCommandBuffer, VkBuffer, VkDeviceSize) { order += 'I'; };
        vk.vkCmdBindPipeline = [](VkCommandBuffer, VkPipelineBindPoint, VkPipeline) { ++pipelines; };
        vk.vkCmdBindDescriptorSets = [](VkCommandBuffer, VkPipelineBindPoint, VkPipelineLayout, std::uint32_t,
                                        std::uint32_t, const VkDescriptorSet*, std::uint32_t,
                                        const std::uint32_t*) { ++sets; };
    }
};

} // namespace

TEST_CASE("barriers are recorded exactly where the list says, with what the dispatches after them need")
{
    TAUT_VULKAN_DEVICE(device);
    static const auto tick = kernel_of("tick", "PARAMS { uint count; };\nCOUNTERS(0, events);\n"
                                               "KERNEL(count) { COUNT_EVENT(events, 0); }\n");
    const BufferPtr x = device->make_buffer(256, "x");
    const BufferPtr y = device->make_buffer(256, "y");
    const BufferPtr groups = device->make_buffer(12, "groups");
    const BufferPtr events = device->make_buffer(4, "events");
    const CountParams most = {64};
    Recorder recorder(device);
    recorder.dispatch(affine(), {x}, AffineParams{64, 1, 1}, 64);
    recorder.dispatch(affine(), {y}, AffineParams{64, 1, 1}, 64);
    recorder.dispatch(affine(), {x}, AffineParams{64, 1, 1}, 64); // barrier before
    recorder.dispatch(affine(), {groups}, AffineParams{3, 1, 1}, 3);
    recorder.dispatch_indirect(tick->info, {events}, std::as_bytes(std::span(&most, 1)), {groups, 0, 12}, 64);
    recorder.dispatch(affine(), {y}, AffineParams{64, 1, 1}, 64);
    recorder.dispatch(affine(), {groups}, AffineParams{3, 1, 1},
                      3); // barrier before: the arguments were read
    const Script script(vulkan::context_of(*device)->vk);
    const auto recording = recorder.finish();
    REQUIRE(Script::order == "BDDBDDBIDBDB");
    const auto& b = Script::barriers;
    const VkPipelineStageFlags compute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
    const VkPipelineStageFlags indirect = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
    const VkAccessFlags shader = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    const VkAccessFlags arguments = VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    // Everything before the list, and everything after it.
    CHECK((b[0].from & VK_PIPELINE_STAGE_ALL_COMMANDS_BIT) != 0);
    CHECK((b[0].from & VK_PIPELINE_STAGE_HOST_BIT) != 0);
    CHECK((b[0].to & (compute | indirect)) == (compute | indirect));
    CHECK((b[0].written & VK_ACCESS_MEMORY_WRITE_BIT) != 0);
    CHECK((b[0].used & (shader | arguments)) == (shader | arguments));
    CHECK((b[4].from & compute) != 0);
    CHECK((b[4].to & VK_PIPELINE_STAGE_ALL_COMMANDS_BIT) != 0);
    CHECK((b[4].used & VK_ACCESS_MEMORY_READ_BIT) != 0);
    // Between dispatches: as little as is needed.
    for (const int i : {1, 2, 3})
    {
        const Script::Barrier& between = b[static_cast<std::size_t>(i)];
        CHECK(between.from == compute);
        CHECK(between.written == VK_ACCESS_SHADER_WRITE_BIT);
        CHECK(between.to == (i == 2 ? compute | indirect : compute));
        CHECK(between.used == (i == 2 ? shader | arguments : shader));
    }
    // affine, tick, affine; and the sets x, y, x, groups, events, y, groups.
    CHECK(Script::pipelines == 3);
    CHECK(Script::sets == 7);
}

TEST_CASE("dispatches with the same bindings share a descriptor set")
{
    TAUT_VULKAN_DEVICE(device);
    const BufferPtr x = device->make_buffer(256, "x");
    Recorder recorder(device);
    for (std::uint32_t colour = 0; colour < 12; ++colour)
        recorder.dispatch(affine(), {x}, AffineParams{64, 1, static_cast<float>(colour)}, 64);
    const Script script(vulkan::context_of(*device)->vk);
    const auto recording = recorder.finish();
    CHECK(Script::pipelines == 1);
    CHECK(Script::sets == 1);
    CHECK(Script::order == "BDBDBDBDBDBDBDBDBDBDBDBDB");
}
