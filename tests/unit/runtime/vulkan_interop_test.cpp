// A host with a Vulkan device of its own, made here with nothing but the loader, hands it to Taut.

#include "vulkan_host.hpp"
#include "vulkan_support.hpp"

#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/vulkan/interop.hpp"

#include <cstring>
#include <thread>

using namespace taut;
using namespace taut::vulkan_test;

namespace {

std::unique_ptr<Recording> twice(const std::shared_ptr<Device>& device, const BufferPtr& x, std::uint32_t n)
{
    Recorder recorder(device);
    recorder.dispatch(affine(), {x}, AffineParams{n, 2, 1}, n);
    recorder.dispatch(affine(), {x}, AffineParams{n, 2, 1}, n);
    return recorder.finish();
}

} // namespace

TEST_CASE("a device that the host made computes, and is still the host's afterwards")
{
    const std::unique_ptr<Host> host = Host::open();
    if (!host)
        return;
    {
        const std::shared_ptr<Device> device = adopt(host->context());
        CHECK(device->info().executor == "vulkan");
        CHECK(device->info().selector == "adopted");
        CHECK(!device->limits().float64);
        const BufferPtr x = device->make_buffer(4 * 1000, "x");
        const auto recording = twice(device, x, 1000);
        recording->replay();
        recording->replay();
        CHECK(device->read<float>(x, 1000) == std::vector<float>(1000, 15.0f));
        CHECK(recording->replay_timed().size() == 2);
    }
    host->begin(); // the queue and the device still work
    host->submit_and_wait();
    CHECK(host->messages == "");
}

TEST_CASE("two hosts' devices and an own one work side by side")
{
    const std::unique_ptr<Host> first = Host::open();
    if (!first)
        return;
    const std::unique_ptr<Host> second = Host::open();
    const std::vector<std::shared_ptr<Device>> devices = {adopt(first->context()), open_vulkan(0, {}),
                                                          adopt(second->context())};
    std::vector<BufferPtr> buffers;
    for (const auto& device : devices)
    {
        buffers.push_back(device->make_buffer(64, "x"));
        twice(device, buffers.back(), 16)->replay();
    }
    for (std::size_t i = 0; i < devices.size(); ++i)
        CHECK(devices[i]->read<float>(buffers[i], 16) == std::vector<float>(16, 3.0f));
    CHECK(refusal([&] { devices[0]->read<float>(buffers[2], 1); }).code == ErrorCode::bad_input);
    CHECK(first->messages + second->messages == "");
}

TEST_CASE("a host records a step among its own commands and copies from the simulation's buffer")
{
    const std::unique_ptr<Host> host = Host::open();
    if (!host)
        return;
    {
        const std::shared_ptr<Device> device = adopt(host->context());
        const std::uint32_t n = 3000;
        const BufferPtr x = device->make_buffer(4 * n, "x");
        const BufferPtr copy = device->make_buffer(4 * n, "copy");
        const auto recording = twice(device, x, n);
        const std::uint64_t submissions = device->counters().submissions;

        VkDeviceSize from = 77, to = 77;
        const VkBuffer source = vulkan_buffer(x, &from);
        const VkBuffer target = vulkan_buffer(copy, &to);
        REQUIRE(source != VK_NULL_HANDLE);
        host->begin();
        // Fill, step, copy, step: the barriers around a step make this right without any of the host's.
        const float one = 1;
        std::uint32_t bits = 0;
        std::memcpy(&bits, &one, 4);
        host->call<PFN_vkCmdFillBuffer>("vkCmdFillBuffer")(host->commands, source, from, 4 * n, bits);
        record_into(*recording, host->commands);
        const VkBufferCopy region = {from, to, 4 * n};
        host->call<PFN_vkCmdCopyBuffer>("vkCmdCopyBuffer")(host->commands, source, target, 1, &region);
        record_into_vulkan(*recording, host->commands);
        CHECK(device->counters().submissions == submissions);
        host->submit_and_wait();

        CHECK(device->read<float>(copy, n) == std::vector<float>(n, 7.0f));
        CHECK(device->read<float>(x, n) == std::vector<float>(n, 31.0f));
    }
    CHECK(host->messages == "");
}

namespace {

/// A loader that a host put around the real one: it looks at every submission.
struct Watch
{
    static inline PFN_vkGetInstanceProcAddr loader = nullptr;
    static inline PFN_vkGetDeviceProcAddr device_loader = nullptr;
    static inline PFN_vkQueueSubmit submit = nullptr;
    static inline std::mutex queue_mutex;
    static inline int submissions = 0;
    static inline int unlocked = 0;

    static VKAPI_ATTR VkResult VKAPI_CALL on_submit(VkQueue queue, std::uint32_t count,
                                                    const VkSubmitInfo* infos, VkFence fence)
    {
        ++submissions;
        std::thread([] { // another thread: a mutex may not be tried by its owner
            if (queue_mutex.try_lock())
            {
                ++unlocked;
                queue_mutex.unlock();
            }
        })
            .join();
        return submit(queue, count, infos, fence);
    }

    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL from_device(VkDevice device, const char* name)
    {
        const PFN_vkVoidFunction real = device_loader(device, name);
        if (std::strcmp(name, "vkQueueSubmit") != 0)
            return real;
        submit = reinterpret_cast<PFN_vkQueueSubmit>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(on_submit);
    }

    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL from_instance(VkInstance instance, const char* name)
    {
        const PFN_vkVoidFunction real = loader(instance, name);
        if (std::strcmp(name, "vkGetDeviceProcAddr") != 0)
            return real;
        device_loader = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(from_device);
    }
};

} // namespace

TEST_CASE("every submission goes through the host's loader with the host's queue mutex held")
{
    const std::unique_ptr<Host> host = Host::open();
    if (!host)
        return;
    VulkanContext context = host->context();
    Watch::loader = context.get_instance_proc_addr;
    Watch::submissions = Watch::unlocked = 0;
    context.get_instance_proc_addr = Watch::from_instance;
    context.queue_mutex = &Watch::queue_mutex;
    const std::shared_ptr<Device> device = adopt(context);
    const BufferPtr x = device->make_buffer(64, "x");
    twice(device, x, 16)->replay();
    CHECK(device->read<float>(x, 16) == std::vector<float>(16, 3.0f));
    CHECK(Watch::submissions == static_cast<int>(device->counters().submissions));
    CHECK(Watch::submissions == 3); // zero fill, replay, read
    CHECK(Watch::unlocked == 0);
    CHECK(host->messages == "");
}

TEST_CASE("a host's device without 64-bit floats refuses double kernels, one with them takes them")
{
    const auto kernel = kernel_of("third",
                                  "PARAMS { uint count; };\nUPDATE(0, real, x);\n"
                                  "KERNEL(count) { x[i] = x[i] / real(3); }\n",
                                  Precision::float64);
    const auto run = [&](const Host& host) {
        const std::shared_ptr<Device> device = adopt(host.context());
        const BufferPtr x = upload(*device, std::vector<double>(8, 1.0));
        Recorder recorder(device);
        recorder.dispatch(kernel->info, {x}, CountParams{8}, 8);
        recorder.finish()->replay();
        return device->read<double>(x, 8);
    };
    const std::unique_ptr<Host> without = Host::open(false);
    if (!without)
        return;
    CHECK(refusal([&] { run(*without); }).code == ErrorCode::unsupported);
    CHECK(without->messages == "");
    if (!list_vulkan().front().limits.float64)
        return;
    const std::unique_ptr<Host> with = Host::open(true);
    CHECK(run(*with) == std::vector<double>(8, 1.0 / 3.0));
    CHECK(with->messages == "");
}

TEST_CASE("an incomplete Vulkan context is refused with the name of the field")
{
    const std::unique_ptr<Host> host = Host::open();
    if (!host)
        return;
    const auto broken = [&](const std::function<void(VulkanContext&)>& change) {
        VulkanContext context = host->context();
        change(context);
        return refusal([&] { adopt(context); });
    };
    const auto names = [&](const char* field, ErrorCode code,
                           const std::function<void(VulkanContext&)>& change) {
        const Refusal refused = broken(change);
        INFO(field << ": " << refused.text);
        CHECK(refused.code == code);
        CHECK(contains(refused.text, std::string("VulkanContext::") + field));
    };
    const ErrorCode bad = ErrorCode::bad_input;
    names("instance", bad, [](VulkanContext& c) { c.instance = VK_NULL_HANDLE; });
    names("physical_device", bad, [](VulkanContext& c) { c.physical_device = VK_NULL_HANDLE; });
    names("device", bad, [](VulkanContext& c) { c.device = VK_NULL_HANDLE; });
    names("queue", bad, [](VulkanContext& c) { c.queue = VK_NULL_HANDLE; });
    names("get_instance_proc_addr", bad, [](VulkanContext& c) { c.get_instance_proc_addr = nullptr; });
    names("queue_family", bad, [](VulkanContext& c) { c.queue_family = 1000; });
    names("api_version", ErrorCode::unsupported,
          [](VulkanContext& c) { c.api_version = VK_API_VERSION_1_0; });
    names("api_version", ErrorCode::unsupported, [](VulkanContext& c) { c.api_version = 0; });
    CHECK(host->messages == "");
}

namespace {

/// A loader that makes the device look worse than it is.
struct Poor
{
    static inline PFN_vkGetInstanceProcAddr loader = nullptr;
    static inline VkInstance instance = VK_NULL_HANDLE;
    static inline std::string what;

    template <typename Function>
    static Function real(const char* name)
    {
        return reinterpret_cast<Function>(loader(instance, name));
    }

    static VKAPI_ATTR void VKAPI_CALL families(VkPhysicalDevice device, std::uint32_t* count,
                                               VkQueueFamilyProperties* out)
    {
        real<PFN_vkGetPhysicalDeviceQueueFamilyProperties>("vkGetPhysicalDeviceQueueFamilyProperties")(
            device, count, out);
        for (std::uint32_t i = 0; out != nullptr && i < *count; ++i)
            out[i].queueFlags &= ~VkQueueFlags{VK_QUEUE_COMPUTE_BIT};
    }

    static VKAPI_ATTR void VKAPI_CALL features(VkPhysicalDevice device, VkPhysicalDeviceFeatures* out)
    {
        real<PFN_vkGetPhysicalDeviceFeatures>("vkGetPhysicalDeviceFeatures")(device, out);
        out->shaderFloat64 = VK_FALSE;
    }

    static VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* out)
    {
        real<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(device, out);
        out->apiVersion = VK_API_VERSION_1_0;
    }

    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get(VkInstance, const char* name)
    {
        if (what != name)
            return loader(instance, name);
        if (what == "vkGetPhysicalDeviceQueueFamilyProperties")
            return reinterpret_cast<PFN_vkVoidFunction>(families);
        if (what == "vkGetPhysicalDeviceFeatures")
            return reinterpret_cast<PFN_vkVoidFunction>(features);
        if (what == "vkGetPhysicalDeviceProperties")
            return reinterpret_cast<PFN_vkVoidFunction>(properties);
        return nullptr;
    }
};

} // namespace

TEST_CASE("a host's device that lacks what Taut needs is refused with the reason")
{
    const std::unique_ptr<Host> host = Host::open();
    if (!host)
        return;
    VulkanContext context = host->context();
    context.shader_float64 = true;
    Poor::loader = context.get_instance_proc_addr;
    Poor::instance = context.instance;
    context.get_instance_proc_addr = Poor::get;
    const auto refused = [&](const char* function, ErrorCode code, const char* word) {
        Poor::what = function;
        const Refusal found = refusal([&] { adopt(context); });
        INFO(found.text);
        CHECK(found.code == code);
        CHECK(contains(found.text, word));
    };
    refused("vkGetPhysicalDeviceQueueFamilyProperties", ErrorCode::unsupported, "VK_QUEUE_COMPUTE_BIT");
    refused("vkGetPhysicalDeviceFeatures", ErrorCode::unsupported, "shader_float64");
    refused("vkGetPhysicalDeviceProperties", ErrorCode::unsupported, "1.1");
    refused("vkCreateDevice", ErrorCode::bad_input, "vkCreateDevice"); // a loader that does not know it
    CHECK(host->messages == "");
}

TEST_CASE("recordings and buffers of other executors are refused where Vulkan handles are asked for")
{
    const std::shared_ptr<Device> device = open_cpu(CpuMode::serial, {});
    const BufferPtr x = device->make_buffer(64, "x");
    CHECK(refusal([&] { vulkan_buffer(x); }).code == ErrorCode::unsupported);
    CHECK(refusal([&] { vulkan_buffer(nullptr); }).code == ErrorCode::unsupported);
    const auto recording = Recorder(device).finish();
    CHECK(refusal([&] { record_into_vulkan(*recording, nullptr); }).code == ErrorCode::unsupported);
    CHECK(validation_messages(*device).empty());
}
