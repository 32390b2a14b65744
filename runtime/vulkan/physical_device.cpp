// Reads a physical device: identity, driver, limits, the queue family that computes.

#include "taut/runtime/vulkan/instance.hpp"
#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>
#include <cstring>

namespace taut::vulkan {
namespace {

std::vector<VkExtensionProperties> extensions_of(const Instance& instance, VkPhysicalDevice handle)
{
    const char* const call = "vkEnumerateDeviceExtensionProperties";
    std::uint32_t count = 0;
    check(instance.table.EnumerateDeviceExtensionProperties(handle, nullptr, &count, nullptr), call);
    std::vector<VkExtensionProperties> all(count);
    check(instance.table.EnumerateDeviceExtensionProperties(handle, nullptr, &count, all.data()), call);
    return all;
}

bool contains(const std::vector<VkExtensionProperties>& all, const char* name)
{
    return std::any_of(all.begin(), all.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

std::string version_text(std::uint32_t version)
{
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

DeviceLimits limits_of(const VkPhysicalDeviceLimits& l, VkDeviceSize largest_allocation, bool float64)
{
    DeviceLimits out;
    out.max_buffer_bytes = std::min<std::uint64_t>(l.maxStorageBufferRange, largest_allocation);
    out.offset_alignment = l.minStorageBufferOffsetAlignment;
    out.max_groups_per_dimension = std::min(l.maxComputeWorkGroupCount[0], l.maxComputeWorkGroupCount[1]);
    // Some drivers offer 2^31 in x and 65,535 in y; x alone then holds every list that we make.
    if (l.maxComputeWorkGroupCount[0] > 0x00FFFFFFu)
        out.max_groups_per_dimension = l.maxComputeWorkGroupCount[0];
    out.max_group_size = std::min(l.maxComputeWorkGroupInvocations, l.maxComputeWorkGroupSize[0]);
    out.max_shared_bytes = l.maxComputeSharedMemorySize;
    out.max_param_bytes = l.maxPushConstantsSize;
    out.max_bindings = std::min(
        {l.maxPerStageDescriptorStorageBuffers, l.maxDescriptorSetStorageBuffers, l.maxPerStageResources});
    out.float64 = float64;
    return out;
}

void find_queue(const Instance& instance, PhysicalDevice& device)
{
    std::uint32_t count = 0;
    instance.table.GetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.table.GetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    const auto pick = [&](VkQueueFlags wanted) {
        for (std::uint32_t i = 0; i < count && !device.has_compute; ++i)
            if (families[i].queueCount > 0 && (families[i].queueFlags & wanted) == wanted)
            {
                device.queue_family = i;
                device.family = families[i];
                device.has_compute = true;
            }
    };
    pick(VK_QUEUE_COMPUTE_BIT | VK_QUEUE_GRAPHICS_BIT);
    pick(VK_QUEUE_COMPUTE_BIT);
}

int rank(VkPhysicalDeviceType type)
{
    switch (type)
    {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return 4;
    default: return 3;
    }
}

} // namespace

PhysicalDevice describe(const Instance& instance, VkPhysicalDevice handle)
{
    PhysicalDevice device;
    device.handle = handle;
    const std::vector<VkExtensionProperties> extensions = extensions_of(instance, handle);
    device.portability_subset = contains(extensions, "VK_KHR_portability_subset");
    device.float_controls_extension = contains(extensions, VK_KHR_SHADER_FLOAT_CONTROLS_EXTENSION_NAME);
    instance.table.GetPhysicalDeviceProperties(handle, &device.properties);
    instance.table.GetPhysicalDeviceMemoryProperties(handle, &device.memory);
    if (device.properties.apiVersion < VK_API_VERSION_1_1)
        return device;

    auto driver =
        start<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto maintenance = start<VkPhysicalDeviceMaintenance3Properties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES);
    auto id = start<VkPhysicalDeviceIDProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES);
    auto all = start<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    all.pNext = &id;
    id.pNext = &maintenance;
    const bool names_driver = device.properties.apiVersion >= VK_API_VERSION_1_2 ||
                              contains(extensions, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME);
    if (names_driver)
        maintenance.pNext = &driver;
    auto floats = start<VkPhysicalDeviceFloatControlsProperties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES);
    floats.pNext = id.pNext;
    if (device.properties.apiVersion >= VK_API_VERSION_1_2 || device.float_controls_extension)
        id.pNext = &floats;
    instance.table.GetPhysicalDeviceProperties2(handle, &all);
    VkPhysicalDeviceFeatures features = {};
    instance.table.GetPhysicalDeviceFeatures(handle, &features);

    device.float_controls = float_controls(floats);
    std::copy_n(id.deviceUUID, VK_UUID_SIZE, device.uuid.begin());
    device.info.executor = "vulkan";
    device.info.name = device.properties.deviceName;
    device.info.driver = names_driver ? std::string(driver.driverName) + " " + driver.driverInfo
                                      : "driver " + std::to_string(device.properties.driverVersion);
    device.info.driver += ", Vulkan " + version_text(device.properties.apiVersion);
    device.info.hardware_gpu = device.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    device.info.limits = limits_of(device.properties.limits, maintenance.maxMemoryAllocationSize,
                                   features.shaderFloat64 == VK_TRUE);
    find_queue(instance, device);
    return device;
}

std::vector<PhysicalDevice> physical_devices(const Instance& instance)
{
    std::uint32_t count = 0;
    check(instance.table.EnumeratePhysicalDevices(instance.handle, &count, nullptr),
          "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> handles(count);
    check(instance.table.EnumeratePhysicalDevices(instance.handle, &count, handles.data()),
          "vkEnumeratePhysicalDevices");
    std::vector<PhysicalDevice> devices;
    for (const VkPhysicalDevice handle : handles)
    {
        PhysicalDevice device = describe(instance, handle);
        const bool known = device.uuid != decltype(device.uuid){} &&
                           std::any_of(devices.begin(), devices.end(), [&](const PhysicalDevice& other) {
                               return other.uuid == device.uuid;
                           });
        if (device.has_compute && !known)
            devices.push_back(std::move(device));
    }
    std::stable_sort(devices.begin(), devices.end(), [](const PhysicalDevice& a, const PhysicalDevice& b) {
        return rank(a.properties.deviceType) < rank(b.properties.deviceType);
    });
    return devices;
}

} // namespace taut::vulkan
