#pragma once
// The instance, the validation layers and the list of physical devices.

#include "taut/runtime/device.hpp"
#include "taut/runtime/vulkan/float_controls.hpp"

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace taut::vulkan {

/// What the validation layers said. Shared, so that it can be read after the device is gone.
class ValidationLog
{
public:
    void add(const char* text);
    std::uint64_t count() const;
    std::vector<std::string> texts() const;

private:
    mutable std::mutex mutex_;
    std::uint64_t count_ = 0;
    std::vector<std::string> texts_;
};

// Instance functions, loaded for each instance: volk has one global pointer for all of them.
#define TAUT_INSTANCE_FUNCTIONS(X)                                                                           \
    X(DestroyInstance)                                                                                       \
    X(EnumeratePhysicalDevices)                                                                              \
    X(GetPhysicalDeviceProperties)                                                                           \
    X(GetPhysicalDeviceProperties2)                                                                          \
    X(GetPhysicalDeviceFeatures)                                                                             \
    X(GetPhysicalDeviceMemoryProperties)                                                                     \
    X(GetPhysicalDeviceQueueFamilyProperties)                                                                \
    X(GetPhysicalDeviceFormatProperties)                                                                     \
    X(EnumerateDeviceExtensionProperties)                                                                    \
    X(CreateDevice)                                                                                          \
    X(GetDeviceProcAddr)

struct InstanceTable
{
#define TAUT_MEMBER(name) PFN_vk##name name = nullptr;
    TAUT_INSTANCE_FUNCTIONS(TAUT_MEMBER)
#undef TAUT_MEMBER
    PFN_vkCreateDebugUtilsMessengerEXT CreateDebugUtilsMessengerEXT = nullptr; ///< null without the extension
    PFN_vkDestroyDebugUtilsMessengerEXT DestroyDebugUtilsMessengerEXT = nullptr;
    PFN_vkSetDebugUtilsObjectNameEXT SetDebugUtilsObjectNameEXT = nullptr;
};

/// Owns a VkInstance, or stands for a host's.
class Instance
{
public:
    /// Throws Error{no_device} without a loader or a driver, Error{unsupported} when `validation` asks for a
    /// layer that is not installed.
    static std::shared_ptr<Instance> create(bool validation);

    /// On a host's instance. Throws Error{bad_input} when the loader does not give a needed function.
    static std::shared_ptr<Instance> borrow(VkInstance handle, PFN_vkGetInstanceProcAddr loader);

    Instance() = default;
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    VkInstance handle = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr loader = nullptr;
    InstanceTable table;
    std::shared_ptr<ValidationLog> log; ///< null without validation

private:
    bool owned_ = false;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

/// One physical device and what the executor needs to know of it.
struct PhysicalDevice
{
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    VkPhysicalDeviceProperties properties = {};
    VkPhysicalDeviceMemoryProperties memory = {};
    VkQueueFamilyProperties family = {};
    std::uint32_t queue_family = 0; ///< with compute; with graphics as well where there is one
    bool has_compute = false;
    bool portability_subset = false;
    bool float_controls_extension = false; ///< VK_KHR_shader_float_controls
    FloatControls float_controls;          ///< what the extension, or Vulkan 1.2, offers
    std::array<std::uint8_t, VK_UUID_SIZE> uuid = {};
    DeviceInfo info; ///< selector is left empty
};

/// Reads everything. `info.limits.float64` says what the device has, not what was enabled.
PhysicalDevice describe(const Instance& instance, VkPhysicalDevice handle);

/// Usable devices, best first, each UUID once.
std::vector<PhysicalDevice> physical_devices(const Instance& instance);

} // namespace taut::vulkan
