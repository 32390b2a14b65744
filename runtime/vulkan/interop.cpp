#include "taut/runtime/vulkan/interop.hpp"

#include "taut/runtime/vulkan/recording.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <algorithm>

namespace taut {
namespace {

void require(bool given, const char* field)
{
    if (!given)
        throw Error(ErrorCode::bad_input,
                    std::string("VulkanContext::") + field +
                        " is null; fill it with the handle of the device that Taut is to use");
}

std::string version_text(std::uint32_t version)
{
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version));
}

void require_version(std::uint32_t version, const char* what)
{
    const std::uint32_t needed = vulkan_requirements().api_version;
    if (version < needed)
        throw Error(ErrorCode::unsupported, std::string(what) + " is Vulkan " + version_text(version) +
                                                "; Taut needs " + version_text(needed));
}

void require_handles(const VulkanContext& host)
{
    require(host.instance != VK_NULL_HANDLE, "instance");
    require(host.physical_device != VK_NULL_HANDLE, "physical_device");
    require(host.device != VK_NULL_HANDLE, "device");
    require(host.queue != VK_NULL_HANDLE, "queue");
    require(host.get_instance_proc_addr != nullptr, "get_instance_proc_addr");
    require_version(host.api_version, "VulkanContext::api_version");
}

/// Takes the host's queue family in place of the one that open_vulkan would choose.
void use_family(const vulkan::Instance& instance, vulkan::PhysicalDevice& device, std::uint32_t index)
{
    std::uint32_t count = 0;
    instance.table.GetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    instance.table.GetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
    if (index >= count)
        throw Error(ErrorCode::bad_input, "VulkanContext::queue_family is " + std::to_string(index) +
                                              ", the device has " + std::to_string(count) + " families");
    if ((families[index].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
        throw Error(ErrorCode::unsupported,
                    "VulkanContext::queue_family " + std::to_string(index) +
                        " has no compute; take a queue of a family with VK_QUEUE_COMPUTE_BIT");
    device.queue_family = index;
    device.family = families[index];
}

} // namespace

VulkanRequirements vulkan_requirements(Precision precision)
{
    VulkanRequirements out;
    out.features.shaderFloat64 = precision == Precision::float64 ? VK_TRUE : VK_FALSE;
    return out;
}

std::shared_ptr<Device> adopt(const VulkanContext& host)
{
    require_handles(host);
    std::shared_ptr<vulkan::Instance> instance =
        vulkan::Instance::borrow(host.instance, host.get_instance_proc_addr);
    vulkan::PhysicalDevice device = vulkan::describe(*instance, host.physical_device);
    require_version(device.properties.apiVersion, "VulkanContext::physical_device");
    use_family(*instance, device, host.queue_family);
    if (host.shader_float64 && !device.info.limits.float64)
        throw Error(ErrorCode::unsupported,
                    "VulkanContext::shader_float64 is true, but " + device.info.name +
                        " has no 64-bit floats; set it to what the device was created with");
    device.info.limits.float64 = host.shader_float64;
    device.info.selector = "adopted";
    DeviceInfo info = device.info;
    return vulkan::make_device(vulkan::Context::borrow(std::move(instance), std::move(device), host),
                               std::move(info));
}

void record_into(Recording& recording, VkCommandBuffer commands, std::span<const BufferWrite> writes)
{
    auto* const own = dynamic_cast<vulkan::VulkanRecording*>(&recording);
    if (own == nullptr)
        throw Error(ErrorCode::unsupported,
                    "only a recording of a Vulkan device can be recorded into a Vulkan "
                    "command buffer; compile it on one");
    if (commands == VK_NULL_HANDLE)
        throw Error(ErrorCode::bad_input, "the command buffer is null; give one in the recording state");
    own->record_into(commands, writes);
}

void record_into_vulkan(Recording& recording, VkCommandBuffer_T* commands,
                        std::span<const BufferWrite> writes)
{
    record_into(recording, commands, writes);
}

VkBuffer vulkan_buffer(const BufferPtr& buffer, VkDeviceSize* offset)
{
    const VkBuffer handle = vulkan::vulkan_buffer_of(buffer).handle;
    if (offset != nullptr)
        *offset = 0; // every Buffer has a VkBuffer of its own
    return handle;
}

} // namespace taut
