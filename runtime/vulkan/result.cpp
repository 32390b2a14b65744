#include "taut/runtime/vulkan/result.hpp"

namespace taut::vulkan {
namespace {

ErrorCode code_of(VkResult result)
{
    switch (result)
    {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_TOO_MANY_OBJECTS: return ErrorCode::out_of_memory;
    case VK_ERROR_DEVICE_LOST: return ErrorCode::device_lost;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_INITIALIZATION_FAILED: return ErrorCode::no_device;
    default: return ErrorCode::unsupported;
    }
}

const char* advice_for(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::out_of_memory: return "; use smaller buffers or close what else uses the device";
    case ErrorCode::device_lost: return "; the device stopped working and must be opened again";
    case ErrorCode::no_device: return "; check the installed Vulkan driver with vulkaninfo";
    default: return "; the driver cannot do this";
    }
}

} // namespace

std::string name_of(VkResult result)
{
#define TAUT_NAME(value)                                                                                     \
    case value: return #value
    switch (result)
    {
        TAUT_NAME(VK_SUCCESS);
        TAUT_NAME(VK_NOT_READY);
        TAUT_NAME(VK_TIMEOUT);
        TAUT_NAME(VK_INCOMPLETE);
        TAUT_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
        TAUT_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        TAUT_NAME(VK_ERROR_INITIALIZATION_FAILED);
        TAUT_NAME(VK_ERROR_DEVICE_LOST);
        TAUT_NAME(VK_ERROR_MEMORY_MAP_FAILED);
        TAUT_NAME(VK_ERROR_LAYER_NOT_PRESENT);
        TAUT_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
        TAUT_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
        TAUT_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
        TAUT_NAME(VK_ERROR_TOO_MANY_OBJECTS);
        TAUT_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
        TAUT_NAME(VK_ERROR_FRAGMENTED_POOL);
        TAUT_NAME(VK_ERROR_OUT_OF_POOL_MEMORY);
        TAUT_NAME(VK_ERROR_INVALID_SHADER_NV);
        TAUT_NAME(VK_ERROR_UNKNOWN);
    default: return "VkResult " + std::to_string(static_cast<int>(result));
    }
#undef TAUT_NAME
}

void check(VkResult result, const char* call)
{
    if (result >= VK_SUCCESS)
        return;
    const ErrorCode code = code_of(result);
    throw Error(code, std::string(call) + " returned " + name_of(result) + advice_for(code));
}

void Health::check(VkResult result, const char* call)
{
    if (result == VK_ERROR_DEVICE_LOST)
        lost_.store(true);
    vulkan::check(result, call);
}

void Health::require_alive() const
{
    if (lost())
        throw Error(
            ErrorCode::device_lost,
            "the Vulkan device was lost (VK_ERROR_DEVICE_LOST) in an earlier call; open a new device");
}

} // namespace taut::vulkan
