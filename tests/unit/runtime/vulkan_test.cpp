// The Vulkan executor on whatever driver is here (lavapipe will do), with core and synchronisation
// validation.

#include "vulkan_support.hpp"

#include "taut/kernels/xpbd_spring.hpp"
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
            recorder.dispatch(kernels::xpbd_spring::info(variant), bindings,
                              kernels::xpbd_spring::Params{0, n, pass == 0 ? 1u : 0u, 1}, n, "stretch");
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
    VolkDeviceTable& vk = vulkan::context_of(*device)->vk;
    const PFN_vkQueueSubmit submit = vk.vkQueueSubmit;
    vk.vkQueueSubmit = [](VkQueue, std::uint32_t, const VkSubmitInfo*, VkFence) {
        return VK_ERROR_DEVICE_LOST;
    };
    CHECK(
        contains(refusal([&] { recording->replay(); }).text, "vkQueueSubmit returned VK_ERROR_DEVICE_LOST"));
    vk.vkQueueSubmit = submit; // once is enough
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
