#include "taut/runtime/vulkan/draw_objects.hpp"

#include "taut/runtime/vulkan/structs.hpp"

namespace taut::vulkan {

DrawObjects::~DrawObjects()
{
    for (auto it = destroy_.rbegin(); it != destroy_.rend(); ++it)
        (*it)();
}

// Creates through the device table, checks, and notes how to destroy.
#define TAUT_CREATE(Type, info)                                                                              \
    Vk##Type handle = VK_NULL_HANDLE;                                                                        \
    context_->health.check(context_->vk.vkCreate##Type(context_->device, &(info), nullptr, &handle),         \
                           "vkCreate" #Type);                                                                \
    destroy_.push_back([c = context_.get(), handle] { c->vk.vkDestroy##Type(c->device, handle, nullptr); })

VkDeviceMemory DrawObjects::image_memory(VkImage image)
{
    VkMemoryRequirements needs = {};
    context_->vk.vkGetImageMemoryRequirements(context_->device, image, &needs);
    const int type = find_memory_type(context_->physical.memory, needs.memoryTypeBits, 0,
                                      VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    if (type < 0)
        throw Error(ErrorCode::out_of_memory, "the Vulkan device has no memory type for images");
    auto info = start<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = needs.size;
    info.memoryTypeIndex = static_cast<std::uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    context_->health.check(context_->vk.vkAllocateMemory(context_->device, &info, nullptr, &memory),
                           "vkAllocateMemory for an image");
    return memory;
}

DrawImage DrawObjects::image(VkFormat format, VkExtent2D size, VkSampleCountFlagBits samples,
                             VkImageUsageFlags usage, VkImageAspectFlags aspect)
{
    DrawImage out;
    {
        auto info = start<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        TAUT_CREATE(Image, info);
        out.handle = handle;
    }
    const VkDeviceMemory memory = image_memory(out.handle);
    // An image goes before its memory: the memory's turn to be freed comes after, so it is noted before.
    destroy_.insert(destroy_.end() - 1,
                    [c = context_.get(), memory] { c->vk.vkFreeMemory(c->device, memory, nullptr); });
    context_->health.check(context_->vk.vkBindImageMemory(context_->device, out.handle, memory, 0),
                           "vkBindImageMemory");
    auto info = start<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = out.handle;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    TAUT_CREATE(ImageView, info);
    out.view = handle;
    return out;
}

VkSampler DrawObjects::shadow_sampler(bool linear)
{
    auto info = start<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = info.minFilter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE; // nothing is in the way outside the map
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    TAUT_CREATE(Sampler, info);
    return handle;
}

VkDescriptorSetLayout DrawObjects::set_layout(std::span<const VkDescriptorSetLayoutBinding> bindings)
{
    auto info = start<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    TAUT_CREATE(DescriptorSetLayout, info);
    return handle;
}

VkPipelineLayout DrawObjects::pipeline_layout(VkDescriptorSetLayout set, std::uint32_t push_bytes)
{
    const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                       push_bytes};
    auto info = start<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    TAUT_CREATE(PipelineLayout, info);
    return handle;
}

VkDescriptorPool DrawObjects::descriptor_pool(std::uint32_t sets, std::uint32_t buffers_per_set)
{
    const VkDescriptorPoolSize sizes[] = {
        {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, sets * buffers_per_set},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, sets},
    };
    auto info = start<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = sets;
    info.poolSizeCount = 2;
    info.pPoolSizes = sizes;
    TAUT_CREATE(DescriptorPool, info);
    return handle;
}

VkRenderPass DrawObjects::render_pass(const VkRenderPassCreateInfo& info)
{
    TAUT_CREATE(RenderPass, info);
    return handle;
}

VkFramebuffer DrawObjects::framebuffer(VkRenderPass pass, std::span<const VkImageView> views, VkExtent2D size)
{
    auto info = start<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    TAUT_CREATE(Framebuffer, info);
    return handle;
}

VkShaderModule DrawObjects::shader(std::span<const std::uint32_t> spirv)
{
    auto info = start<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    TAUT_CREATE(ShaderModule, info);
    return handle;
}

VkPipeline DrawObjects::pipeline(const VkGraphicsPipelineCreateInfo& info)
{
    VkPipeline handle = VK_NULL_HANDLE;
    context_->health.check(
        context_->vk.vkCreateGraphicsPipelines(context_->device, context_->cache, 1, &info, nullptr, &handle),
        "vkCreateGraphicsPipelines");
    destroy_.push_back([c = context_.get(), handle] { c->vk.vkDestroyPipeline(c->device, handle, nullptr); });
    return handle;
}

#undef TAUT_CREATE

} // namespace taut::vulkan
