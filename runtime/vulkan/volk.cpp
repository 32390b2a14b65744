#include <vulkan/vulkan.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#endif
#define VOLK_IMPLEMENTATION
#include "taut/runtime/vulkan/volk.hpp"
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <mutex>

namespace taut::vulkan {

PFN_vkGetInstanceProcAddr system_loader()
{
    static const bool opened = volkInitialize() == VK_SUCCESS;
    static const PFN_vkGetInstanceProcAddr loader = opened ? vkGetInstanceProcAddr : nullptr;
    return loader;
}

void load_device_table(VolkDeviceTable& table, PFN_vkGetInstanceProcAddr loader, VkInstance instance,
                       VkDevice device)
{
    // volk asks its one global vkGetDeviceProcAddr; a host may have brought a loader of its own.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    vkGetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(loader(instance, "vkGetDeviceProcAddr"));
    volkLoadDeviceTable(&table, device);
}

} // namespace taut::vulkan
