#pragma once
// volk with every name prefixed by taut_ (cmake/volk.cmake says why). Vulkan's own headers come first, so
// that the prefix touches nothing but volk.

#include <vulkan/vulkan_core.h>

#include "taut/volk_names.hpp"

#include <volk.h>

namespace taut::vulkan {

/// Opens the Vulkan loader once per process. Null when there is none.
PFN_vkGetInstanceProcAddr system_loader();

/// Fills the functions of one device through the loader that made it. Thread-safe.
void load_device_table(VolkDeviceTable& table, PFN_vkGetInstanceProcAddr loader, VkInstance instance,
                       VkDevice device);

} // namespace taut::vulkan
