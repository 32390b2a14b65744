#pragma once

#include <vulkan/vulkan_core.h>

namespace taut::vulkan {

/// A Vulkan structure of type `type`, all else zero.
template <typename Struct>
Struct start(VkStructureType type)
{
    Struct out = {};
    out.sType = type;
    return out;
}

} // namespace taut::vulkan
