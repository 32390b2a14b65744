#pragma once
// The pipeline cache on disk. Only a file that this very driver wrote for this very device is believed.

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace taut::vulkan {

/// Whether nothing is there, or a file that such a cache may take the place of: one that begins as caches of
/// Taut do, whatever their version, or an empty one.
bool is_pipeline_cache(const std::string& path);

/// Contents of the file, without its header. Empty when the file is missing, truncated, damaged, of another
/// version of the format, of another device or driver, or no file but a folder or a pipe.
std::vector<std::byte> load_pipeline_cache(const std::string& path, const VkPhysicalDeviceProperties& device);

/// Writes to a temporary name and renames. False when that failed, or when what stands at the path is no
/// such cache; a cache is no reason to stop.
bool save_pipeline_cache(const std::string& path, const VkPhysicalDeviceProperties& device,
                         std::span<const std::byte> contents) noexcept;

} // namespace taut::vulkan
