#pragma once
// Entry points of the Vulkan executor for code that does not name Vulkan. interop.hpp is for code that does.

#include "taut/runtime/device.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct VkCommandBuffer_T;

namespace taut {

/// Every Vulkan device that can run Taut (Vulkan 1.1 and a compute queue), best first: discrete, integrated,
/// virtual, CPU. Empty where there is no loader or driver; never throws for that. The selector of element i
/// is "vulkan:<i>".
std::vector<DeviceInfo> list_vulkan();

/// Opens element `index` of list_vulkan(). Throws Error{no_device} with the reason, Error{unsupported} when
/// options.validation asks for layers that are not installed, Error{io} when the folder of
/// options.pipeline_cache does not exist, or no file but something else stands there.
std::shared_ptr<Device> open_vulkan(std::size_t index, const OpenOptions& options);

/// Same as record_into (interop.hpp). Throws Error{unsupported} for a recording of another executor.
void record_into_vulkan(Recording& recording, VkCommandBuffer_T* commands,
                        std::span<const BufferWrite> writes = {});

/// What the validation layers said so far, warnings and errors, oldest first (at most 1000 texts are kept;
/// the counter goes on). Empty for other devices and without OpenOptions::validation.
std::vector<std::string> validation_messages(const Device& device);

} // namespace taut
