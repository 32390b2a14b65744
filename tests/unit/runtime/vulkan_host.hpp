#pragma once
// What an engine would have: a Vulkan device of its own, made with nothing but the loader.

#include "support/skip.hpp"

#include "taut/runtime/vulkan/interop.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace taut::vulkan_test {

inline constexpr const char* kLayer = "VK_LAYER_KHRONOS_validation";

/// What an engine would have: instance, device, queue, command buffer, and its own count of validation
/// messages.
class Host
{
public:
    static std::unique_ptr<Host> open(bool float64 = false)
    {
        auto host = std::unique_ptr<Host>(new Host);
        void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
        if (list_vulkan().empty() || library == nullptr)
        {
            const char* const required = std::getenv("TAUT_REQUIRE_DEVICE");
            if (required && std::string(required) == "1")
                FAIL("there is no Vulkan device, and TAUT_REQUIRE_DEVICE=1 asks for one");
            TAUT_LEFT_OUT("there is no Vulkan device");
            return nullptr;
        }
        host->get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library, "vkGetInstanceProcAddr"));
        host->make_instance();
        host->make_device(float64);
        host->make_commands();
        return host;
    }

    ~Host()
    {
        if (device != VK_NULL_HANDLE)
        {
            call<PFN_vkDestroyCommandPool>("vkDestroyCommandPool")(device, pool, nullptr);
            call<PFN_vkDestroyDevice>("vkDestroyDevice")(device, nullptr);
            call<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(instance, messenger,
                                                                                         nullptr);
            call<PFN_vkDestroyInstance>("vkDestroyInstance")(instance, nullptr);
        }
    }

    template <typename Function>
    Function call(const char* name) const
    {
        return reinterpret_cast<Function>(get(instance, name));
    }

    VulkanContext context() const
    {
        VulkanContext out;
        out.instance = instance;
        out.physical_device = physical;
        out.device = device;
        out.queue = queue;
        out.queue_family = family;
        out.get_instance_proc_addr = get;
        out.api_version = VK_API_VERSION_1_1;
        out.shader_float64 = float64_enabled;
        return out;
    }

    void begin() const
    {
        VkCommandBufferBeginInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(call<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands, &info) == VK_SUCCESS);
    }

    void submit_and_wait() const
    {
        REQUIRE(call<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands) == VK_SUCCESS);
        VkSubmitInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands;
        REQUIRE(call<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, 1, &info, VK_NULL_HANDLE) == VK_SUCCESS);
        REQUIRE(call<PFN_vkQueueWaitIdle>("vkQueueWaitIdle")(queue) == VK_SUCCESS);
    }

    std::string messages;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr get = nullptr;
    bool float64_enabled = false;

private:
    Host() = default;

    static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                     VkDebugUtilsMessageTypeFlagsEXT,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                     void* host)
    {
        static_cast<Host*>(host)->messages += std::string(data->pMessage) + "\n";
        return VK_FALSE;
    }

    void make_instance()
    {
        VkApplicationInfo app = {};
        app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        app.apiVersion = VK_API_VERSION_1_1;
        const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
        VkInstanceCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &app;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kLayer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
        REQUIRE(call<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &instance) == VK_SUCCESS);
        VkDebugUtilsMessengerCreateInfoEXT hear = {};
        hear.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
        hear.messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
        hear.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
        hear.pfnUserCallback = on_message;
        hear.pUserData = this;
        REQUIRE(call<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(
                    instance, &hear, nullptr, &messenger) == VK_SUCCESS);
    }

    void make_device(bool float64)
    {
        std::uint32_t count = 1;
        call<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices")(instance, &count, &physical);
        std::uint32_t families = 16;
        VkQueueFamilyProperties properties[16];
        call<PFN_vkGetPhysicalDeviceQueueFamilyProperties>("vkGetPhysicalDeviceQueueFamilyProperties")(
            physical, &families, properties);
        while (family < families && (properties[family].queueFlags & vulkan_requirements().queue_flags) == 0)
            ++family;
        const float priority = 1;
        VkDeviceQueueCreateInfo queues = {};
        queues.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queues.queueFamilyIndex = family;
        queues.queueCount = 1;
        queues.pQueuePriorities = &priority;
        const VulkanRequirements needs =
            vulkan_requirements(float64 ? Precision::float64 : Precision::float32);
        VkDeviceCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queues;
        info.enabledExtensionCount = static_cast<std::uint32_t>(needs.device_extensions.size());
        info.ppEnabledExtensionNames = needs.device_extensions.data();
        info.pEnabledFeatures = &needs.features;
        float64_enabled = needs.features.shaderFloat64 == VK_TRUE;
        REQUIRE(call<PFN_vkCreateDevice>("vkCreateDevice")(physical, &info, nullptr, &device) == VK_SUCCESS);
        call<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, family, 0, &queue);
    }

    void make_commands()
    {
        VkCommandPoolCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        info.queueFamilyIndex = family;
        REQUIRE(call<PFN_vkCreateCommandPool>("vkCreateCommandPool")(device, &info, nullptr, &pool) ==
                VK_SUCCESS);
        VkCommandBufferAllocateInfo one = {};
        one.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        one.commandPool = pool;
        one.commandBufferCount = 1;
        REQUIRE(call<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(device, &one, &commands) ==
                VK_SUCCESS);
    }

    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
};

/// Command buffers of a host that has several frames in flight: one is waited for when its turn comes again.
class Flights
{
public:
    Flights(const Host& host, std::size_t count) : host_(host), commands_(count), fences_(count)
    {
        VkCommandBufferAllocateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = host.pool;
        info.commandBufferCount = static_cast<std::uint32_t>(count);
        REQUIRE(host.call<PFN_vkAllocateCommandBuffers>("vkAllocateCommandBuffers")(
                    host.device, &info, commands_.data()) == VK_SUCCESS);
        VkFenceCreateInfo done = {};
        done.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        done.flags = VK_FENCE_CREATE_SIGNALED_BIT;
        for (VkFence& fence : fences_)
            REQUIRE(host.call<PFN_vkCreateFence>("vkCreateFence")(host.device, &done, nullptr, &fence) ==
                    VK_SUCCESS);
    }

    ~Flights()
    {
        wait();
        for (const VkFence fence : fences_)
            host_.call<PFN_vkDestroyFence>("vkDestroyFence")(host_.device, fence, nullptr);
    }

    VkCommandBuffer begin()
    {
        wait_for(fences_[next_]);
        VkCommandBufferBeginInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        REQUIRE(host_.call<PFN_vkBeginCommandBuffer>("vkBeginCommandBuffer")(commands_[next_], &info) ==
                VK_SUCCESS);
        return commands_[next_];
    }

    /// What was begun last; does not wait.
    void submit()
    {
        REQUIRE(host_.call<PFN_vkEndCommandBuffer>("vkEndCommandBuffer")(commands_[next_]) == VK_SUCCESS);
        host_.call<PFN_vkResetFences>("vkResetFences")(host_.device, 1, &fences_[next_]);
        VkSubmitInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_[next_];
        REQUIRE(host_.call<PFN_vkQueueSubmit>("vkQueueSubmit")(host_.queue, 1, &info, fences_[next_]) ==
                VK_SUCCESS);
        next_ = (next_ + 1) % commands_.size();
    }

    void wait() const
    {
        for (const VkFence fence : fences_)
            wait_for(fence);
    }

private:
    void wait_for(VkFence fence) const
    {
        host_.call<PFN_vkWaitForFences>("vkWaitForFences")(host_.device, 1, &fence, VK_TRUE,
                                                           ~std::uint64_t{0});
    }

    const Host& host_;
    std::vector<VkCommandBuffer> commands_;
    std::vector<VkFence> fences_;
    std::size_t next_ = 0;
};

} // namespace taut::vulkan_test
