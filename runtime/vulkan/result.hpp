#pragma once
// Every VkResult goes through here: named in the message, mapped to an ErrorCode, and a lost device stays
// lost.

#include "taut/runtime/base/error.hpp"

#include <vulkan/vulkan_core.h>

#include <atomic>
#include <string>

namespace taut::vulkan {

/// "VK_ERROR_OUT_OF_DEVICE_MEMORY"; unknown values as "VkResult -123".
std::string name_of(VkResult result);

/// Throws for an error: out_of_memory for memory, no_device for a missing driver, device_lost for a lost
/// device, unsupported for the rest. `call` is the function's name.
void check(VkResult result, const char* call);

/// State of one device: after VK_ERROR_DEVICE_LOST nothing may report success any more.
class Health
{
public:
    /// As vulkan::check, and remembers a loss.
    void check(VkResult result, const char* call);

    /// Throws Error{device_lost} if the device was lost before.
    void require_alive() const;

    bool lost() const { return lost_.load(); }

private:
    std::atomic<bool> lost_ = false;
};

} // namespace taut::vulkan
