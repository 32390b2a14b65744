#include "taut/runtime/vulkan/context.hpp"

#include "taut/runtime/vulkan/pipeline_cache.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>

namespace taut::vulkan {

std::shared_ptr<Context> Context::create(std::shared_ptr<Instance> instance, PhysicalDevice physical,
                                         std::string cache_path)
{
    auto context = std::make_shared<Context>();
    context->instance = std::move(instance);
    context->physical = std::move(physical);
    context->cache_path_ = std::move(cache_path);
    context->open_device();
    VkQueue handle = VK_NULL_HANDLE;
    context->vk.vkGetDeviceQueue(context->device, context->physical.queue_family, 0, &handle);
    context->open_cache();
    context->build(handle, nullptr);
    return context;
}

std::shared_ptr<Context> Context::borrow(std::shared_ptr<Instance> instance, PhysicalDevice physical,
                                         const VulkanContext& host)
{
    auto context = std::make_shared<Context>();
    context->instance = std::move(instance);
    context->physical = std::move(physical);
    context->device = host.device;
    if (std::min(host.api_version, context->physical.properties.apiVersion) < VK_API_VERSION_1_2)
        context->physical.float_controls = {}; // the extension is the host's to enable
    context->cache = host.pipeline_cache;
    load_device_table(context->vk, context->instance->loader, context->instance->handle, host.device);
    context->build(host.queue, host.queue_mutex);
    return context;
}

void Context::open_device()
{
    const float priority = 1.0f;
    auto queue_info = start<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue_info.queueFamilyIndex = physical.queue_family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features = {};
    features.shaderFloat64 = physical.info.limits.float64 ? VK_TRUE : VK_FALSE;
    std::vector<const char*> extensions;
    if (physical.portability_subset)
        extensions.push_back("VK_KHR_portability_subset"); // must be enabled where it exists
    if (physical.float_controls_extension)
        extensions.push_back(VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME);
    auto info = start<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue_info;
    info.pEnabledFeatures = &features;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(instance->table.CreateDevice(physical.handle, &info, nullptr, &device), "vkCreateDevice");
    owns_device_ = true;
    load_device_table(vk, instance->loader, instance->handle, device);
}

void Context::open_cache()
{
    const std::vector<std::byte> contents = cache_path_.empty()
                                                ? std::vector<std::byte>{}
                                                : load_pipeline_cache(cache_path_, physical.properties);
    auto info = start<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    info.initialDataSize = contents.size();
    info.pInitialData = contents.data();
    health.check(vk.vkCreatePipelineCache(device, &info, nullptr, &cache), "vkCreatePipelineCache");
    owns_cache_ = true;
}

void Context::build(VkQueue handle, std::mutex* host_mutex)
{
    queue_handle = handle;
    const DeviceLimits& limits = physical.info.limits;
    memory = std::make_unique<Memory>(vk, device, physical.memory, health);
    queue = std::make_unique<Queue>(vk, device, handle, host_mutex, health);
    transfer = std::make_unique<Transfer>(vk, device, physical.memory, physical.queue_family, *queue, health);
    pipelines = std::make_unique<Pipelines>(vk, device, cache, limits, physical.float_controls, health);
}

Context::~Context()
{
    pipelines.reset();
    transfer.reset();
    queue.reset();
    memory.reset();
    if (owns_cache_)
        vk.vkDestroyPipelineCache(device, cache, nullptr);
    if (owns_device_)
        vk.vkDestroyDevice(device, nullptr);
}

void Context::name_object(VkObjectType type, std::uint64_t object, std::string_view name) const
{
    if (!instance->log || instance->table.SetDebugUtilsObjectNameEXT == nullptr || name.empty())
        return;
    const std::string text(name);
    auto info = start<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = text.c_str();
    instance->table.SetDebugUtilsObjectNameEXT(device, &info);
}

void Context::save_cache() noexcept
{
    if (cache_path_.empty() || health.lost())
        return;
    std::size_t bytes = 0;
    if (vk.vkGetPipelineCacheData(device, cache, &bytes, nullptr) != VK_SUCCESS)
        return;
    try
    {
        std::vector<std::byte> contents(bytes);
        if (vk.vkGetPipelineCacheData(device, cache, &bytes, contents.data()) == VK_SUCCESS)
            save_pipeline_cache(cache_path_, physical.properties, std::span(contents).first(bytes));
    }
    catch (const std::bad_alloc&)
    {}
}

} // namespace taut::vulkan
