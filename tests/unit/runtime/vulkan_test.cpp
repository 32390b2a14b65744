// The Vulkan executor on whatever driver is here (lavapipe will do), with core and synchronisation
// validation.

#include "vulkan_support.hpp"

#include "taut/kernels/distance.hpp"
#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/vulkan/context.hpp"
#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>

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

/// Runs `passes` affine passes over x in one recording, one barrier between each two.
std::unique_ptr<Recording> affine_chain(const std::shared_ptr<Device>& device, const BufferPtr& x,
                                        std::uint32_t count, int passes)
{
    Recorder recorder(device);
    for (int i = 0; i < passes; ++i)
        recorder.dispatch(affine(), {x}, AffineParams{count, 2.0f, 1.0f}, count, "chain");
    return recorder.finish();
}

} // namespace

TEST_CASE("a Vulkan device says who it is and what it can do")
{
    TAUT_VULKAN_DEVICE(device);
    const DeviceInfo& info = device->info();
    CHECK(info.selector == "vulkan:0");
    CHECK(info.executor == "vulkan");
    CHECK(!info.name.empty());
    CHECK(contains(info.driver, "Vulkan 1."));
    CHECK(info.limits.max_bindings >= 4);
    CHECK(info.limits.max_group_size >= 128);
    CHECK(info.limits.max_groups_per_dimension >= 65535);
    CHECK(info.limits.max_param_bytes >= 128);
    CHECK(info.limits.max_shared_bytes >= 16384);
    CHECK(info.limits.max_buffer_bytes >= (1u << 27));

    const std::vector<DeviceInfo> all = list_vulkan();
    REQUIRE(!all.empty());
    CHECK(all.front().name == info.name);
    for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(all[i].selector == "vulkan:" + std::to_string(i));
    CHECK(std::is_partitioned(all.begin(), all.end(), [](const DeviceInfo& d) { return d.hardware_gpu; }));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a Vulkan device that is not there is refused with the number that is")
{
    if (list_vulkan().empty())
        return;
    const Refusal refused = refusal([] { open_vulkan(99, {}); });
    CHECK(refused.code == ErrorCode::no_device);
    CHECK(contains(refused.text, "99"));
    CHECK(contains(refused.text, std::to_string(list_vulkan().size())));
}

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

TEST_CASE("a kernel compiled from text at run time computes on Vulkan")
{
    TAUT_VULKAN_DEVICE(device);
    std::vector<float> values(1000);
    std::iota(values.begin(), values.end(), 0.0f);
    const BufferPtr x = upload(*device, values);
    const auto recording = affine_chain(device, x, 1000, 3);
    recording->replay();
    const std::vector<float> found = device->read<float>(x, 1000);
    for (std::size_t i = 0; i < found.size(); ++i)
        REQUIRE(found[i] == 8 * static_cast<float>(i) + 7);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a Vulkan dispatch binds the part of the buffer that it was given")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint64_t step = std::max<std::uint64_t>(256, device->limits().offset_alignment);
    const auto count = static_cast<std::uint32_t>(step / 4);
    const BufferPtr x = upload(*device, std::vector<float>(3 * count, 1.0f));
    Recorder recorder(device);
    recorder.dispatch(affine(), {{x, step, step}}, AffineParams{count, 5, 0}, count);
    recorder.finish()->replay();
    const std::vector<float> found = device->read<float>(x, 3 * count);
    for (std::uint32_t i = 0; i < 3 * count; ++i)
        REQUIRE(found[i] == (i / count == 1 ? 5.0f : 1.0f));
    CHECK_NOTHING_SAID(device);
}

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

TEST_CASE("the distance kernel gives the bits of native code on lavapipe")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint32_t n = 1000;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::vector<layout::DistanceConstraint<float>> constraints;
    for (std::uint32_t i = 0; i < n; ++i)
        constraints.push_back({2 * i, 2 * i + 1, std::abs(uniform(random)), i % 3 == 0 ? 0.0f : 1e-4f});
    std::vector<float> positions(8 * n);
    for (float& v : positions)
        v = uniform(random);
    for (std::size_t i = 3; i < positions.size(); i += 4)
        positions[i] = i % 5 == 0 ? 0.0f : std::abs(positions[i]) + 0.1f; // some are pinned
    std::copy_n(positions.begin(), 4, positions.begin() + 4);             // one pair coincides
    positions[3] = positions[7] = 1.0f;
    layout::StepValues<float> step = {};
    step.inverse_substep = 600.0f;

    const auto run = [&](const std::shared_ptr<Device>& on, std::string_view variant) {
        const BufferPtr delta = on->make_buffer(32 * n, "delta");
        const BufferPtr events = on->make_buffer(64, "events");
        std::vector<Recorder::Binding> bindings = {upload(*on, constraints), upload(*on, positions), delta,
                                                   upload(*on, std::vector{step}), events};
        if (variant == "lambda")
            bindings.push_back(on->make_buffer(4 * n, "multiplier"));
        Recorder recorder(on);
        for (std::uint32_t pass = 0; pass < 3; ++pass)
            recorder.dispatch(kernels::distance::info(variant), bindings,
                              kernels::distance::Params{0, n, pass == 0 ? 1u : 0u, 1}, n, "stretch");
        recorder.finish()->replay();
        std::vector<std::uint32_t> bits = on->read<std::uint32_t>(delta, 8 * n);
        const std::vector<std::uint32_t> counted = on->read<std::uint32_t>(events, 16);
        bits.insert(bits.end(), counted.begin(), counted.end());
        return bits;
    };
    for (const char* variant : {"", "lambda"})
    {
        const std::vector<std::uint32_t> native = run(open_cpu(CpuMode::serial, {}), variant);
        const std::vector<std::uint32_t> found = run(device, variant);
        REQUIRE(std::any_of(native.begin(), native.end(), [](std::uint32_t bits) { return bits != 0; }));
        if (contains(device->info().name, "llvmpipe"))
            CHECK(found == native);
        else
            for (std::size_t i = 0; i < 8 * n; ++i)
            {
                float a = 0, b = 0;
                std::memcpy(&a, &found[i], 4);
                std::memcpy(&b, &native[i], 4);
                REQUIRE(a == Approx(b).margin(1e-5));
            }
    }
    CHECK_NOTHING_SAID(device);
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

TEST_CASE("more than 65,535 groups are folded, and every element runs once")
{
    TAUT_VULKAN_DEVICE(device);
    const std::uint32_t n = 65'536 * kGroupSize + 17;
    static const auto kernel = kernel_of("number", "PARAMS { uint count; };\nUPDATE(0, uint, x);\n"
                                                   "KERNEL(count) { x[i] = x[i] + i + 1u; }\n");
    const BufferPtr x = device->make_buffer(4 * std::uint64_t{n}, "x");
    Recorder recorder(device);
    recorder.dispatch(kernel->info, {x}, CountParams{n}, n);
    recorder.finish()->replay();
    const std::vector<std::uint32_t> found = device->read<std::uint32_t>(x, n);
    for (std::uint32_t i = 0; i < n; ++i)
        if (found[i] != i + 1)
            FAIL("element " << i << " holds " << found[i]);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("an indirect dispatch runs the groups that an earlier dispatch wrote, and none when it wrote zero")
{
    TAUT_VULKAN_DEVICE(device);
    static const auto decide = kernel_of("decide", "PARAMS { uint count; };\nREAD(0, uint, wish);\n"
                                                   "UPDATE(1, uint, groups);\n"
                                                   "KERNEL(count) { groups[i] = i == 0u ? wish[0] : 1u; }\n");
    static const auto tick = kernel_of("tick", "PARAMS { uint count; };\nCOUNTERS(0, events);\n"
                                               "KERNEL(count) { COUNT_EVENT(events, 0); }\n");
    const BufferPtr wish = device->make_buffer(4, "wish");
    const BufferPtr groups = device->make_buffer(16, "groups");
    const BufferPtr events = device->make_buffer(4, "events");
    const CountParams most = {1000};
    Recorder recorder(device);
    recorder.dispatch(decide->info, {wish, groups}, CountParams{3}, 3);
    recorder.dispatch_indirect(tick->info, {events}, std::as_bytes(std::span(&most, 1)), {groups, 0, 12},
                               1000);
    const auto recording = recorder.finish();
    CHECK(recording->barrier_count() == 1);
    std::uint32_t expected = 0;
    for (const std::uint32_t wished : {0u, 2u, 0u, 5u})
    {
        device->write<std::uint32_t>(wish, std::vector{wished});
        recording->replay();
        expected += wished * kGroupSize;
        CHECK(device->read<std::uint32_t>(events, 1) == std::vector{expected});
    }
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("double kernels compute in double where Vulkan has it")
{
    TAUT_VULKAN_DEVICE(device);
    if (!device->limits().float64)
        return;
    const auto kernel = kernel_of("third",
                                  "PARAMS { uint count; };\nUPDATE(0, real, x);\n"
                                  "KERNEL(count) { x[i] = x[i] / real(3); }\n",
                                  Precision::float64);
    const BufferPtr x = upload(*device, std::vector<double>(100, 1.0));
    Recorder recorder(device);
    recorder.dispatch(kernel->info, {x}, CountParams{100}, 100);
    recorder.finish()->replay();
    CHECK(device->read<double>(x, 100) == std::vector<double>(100, 1.0 / 3.0));
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("groups of a Vulkan group kernel share memory across phases")
{
    TAUT_VULKAN_DEVICE(device);
    static const auto kernel =
        kernel_of("reverse", "PARAMS { uint count; };\nUPDATE(0, uint, x);\nSHARED(uint, kept, 32);\n"
                             "GROUP_KERNEL(32) {\n"
                             "    PHASE_BEGIN kept[lane] = x[group * 32u + lane]; PHASE_END\n"
                             "    PHASE_BEGIN x[group * 32u + lane] = kept[31u - lane]; PHASE_END\n"
                             "}\n");
    std::vector<std::uint32_t> values(320);
    std::iota(values.begin(), values.end(), 0u);
    const BufferPtr x = upload(*device, values);
    Recorder recorder(device);
    recorder.dispatch(kernel->info, {x}, CountParams{10}, 10);
    recorder.finish()->replay();
    const std::vector<std::uint32_t> found = device->read<std::uint32_t>(x, 320);
    for (std::uint32_t i = 0; i < 320; ++i)
        REQUIRE(found[i] == i / 32 * 32 + 31 - i % 32);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("threads may replay and read on one Vulkan device at once")
{
    TAUT_VULKAN_DEVICE(device);
    affine(); // compiled before the threads start
    std::vector<std::thread> threads;
    std::atomic<int> wrong = 0;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            const BufferPtr x = device->make_buffer(4 * 1000, "x");
            const auto recording = affine_chain(device, x, 1000, 2);
            for (int i = 0; i < 5; ++i)
                recording->replay();
            if (device->read<float>(x, 1000) != std::vector<float>(1000, 1023.0f)) // 2^10 - 1
                ++wrong;
        });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(wrong == 0);
    CHECK_NOTHING_SAID(device);
}

TEST_CASE("a lost Vulkan device refuses everything from then on")
{
    std::shared_ptr<Device> device = open_here();
    if (!device)
        return;
    const BufferPtr x = device->make_buffer(256, "x");
    const auto recording = affine_chain(device, x, 64, 1);
    vulkan::Health& health = vulkan::context_of(*device)->health;
    CHECK(refusal([&] { health.check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit"); }).code ==
          ErrorCode::device_lost);
    std::vector<std::function<void()>> acts = {
        [&] { recording->replay(); },
        [&] { recording->replay_timed(); },
        [&] { device->wait(); },
        [&] { device->make_buffer(16, "y"); },
        [&] { device->read<float>(x, 1); },
        [&] { device->write<float>(x, std::vector{1.0f}); },
        [&] { affine_chain(device, x, 64, 1); },
    };
    for (const auto& act : acts)
    {
        const Refusal refused = refusal(act);
        CHECK(refused.code == ErrorCode::device_lost);
        CHECK(contains(refused.text, "VK_ERROR_DEVICE_LOST"));
    }
}

TEST_CASE("every Vulkan failure is named and has its code")
{
    const auto code = [](VkResult result) { return refusal([&] { vulkan::check(result, "vkThing"); }).code; };
    CHECK(code(VK_SUCCESS) == std::nullopt);
    CHECK(code(VK_INCOMPLETE) == std::nullopt);
    CHECK(code(VK_ERROR_OUT_OF_DEVICE_MEMORY) == ErrorCode::out_of_memory);
    CHECK(code(VK_ERROR_OUT_OF_HOST_MEMORY) == ErrorCode::out_of_memory);
    CHECK(code(VK_ERROR_DEVICE_LOST) == ErrorCode::device_lost);
    CHECK(code(VK_ERROR_INCOMPATIBLE_DRIVER) == ErrorCode::no_device);
    CHECK(code(VK_ERROR_FEATURE_NOT_PRESENT) == ErrorCode::unsupported);
    const std::string text = refusal([] { vulkan::check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkThing"); }).text;
    CHECK(contains(text, "vkThing"));
    CHECK(contains(text, "VK_ERROR_OUT_OF_DEVICE_MEMORY"));
}
