#include "taut/runtime/vulkan/draw_pipelines.hpp"

#include "taut/runtime/vulkan/structs.hpp"
#include "taut/shaders.hpp"

#include <array>

namespace taut::vulkan {
namespace {

VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentStoreOp store,
                                   VkImageLayout end)
{
    VkAttachmentDescription out = {};
    out.format = format;
    out.samples = samples;
    out.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    out.storeOp = store;
    out.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    out.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    out.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    out.finalLayout = end;
    return out;
}

VkSubpassDependency dependency(std::uint32_t from, std::uint32_t to, VkPipelineStageFlags before,
                               VkPipelineStageFlags after, VkAccessFlags writes, VkAccessFlags reads)
{
    return {from, to, before, after, writes, reads, 0};
}

constexpr VkPipelineStageFlags kDepthStages =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags kDepthAccess =
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

/// One graphics pipeline as values; the members hold what the create info points to.
struct Recipe
{
    VkShaderModule vertex = VK_NULL_HANDLE, fragment = VK_NULL_HANDLE; ///< no fragment: the shadow map
    bool positions = false;                                            ///< vertex input of four floats
    bool depth = true;
};

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, VkShaderModule module)
{
    auto out = start<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    out.stage = which;
    out.module = module;
    out.pName = "main";
    return out;
}

VkPipeline make_pipeline(DrawObjects& objects, VkPipelineLayout layout, VkRenderPass pass,
                         const Recipe& recipe)
{
    const bool shadow = recipe.fragment == VK_NULL_HANDLE;
    const std::array stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, recipe.vertex),
                               stage(VK_SHADER_STAGE_FRAGMENT_BIT, recipe.fragment)};
    const VkVertexInputBindingDescription binding = {0, sizeof(glm::vec4), VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attribute = {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
    auto input = start<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount = recipe.positions ? 1 : 0;
    input.pVertexBindingDescriptions = &binding;
    input.pVertexAttributeDescriptions = &attribute;
    auto assembly = start<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport =
        start<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = 1;
    auto raster = start<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    raster.depthBiasEnable = shadow ? VK_TRUE : VK_FALSE; // against a surface shadowing itself
    raster.depthBiasConstantFactor = 2;
    raster.depthBiasSlopeFactor = 2;
    auto samples =
        start<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = shadow ? VK_SAMPLE_COUNT_1_BIT : kSamples;
    auto depth = start<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = depth.depthWriteEnable = recipe.depth ? VK_TRUE : VK_FALSE;
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState target = {};
    target.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                            VK_COLOR_COMPONENT_A_BIT;
    auto blend =
        start<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = shadow ? 0 : 1;
    blend.pAttachments = &target;
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic =
        start<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = states;
    auto info = start<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = shadow ? 1 : 2;
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    info.renderPass = pass;
    return objects.pipeline(info);
}

VkFormatFeatureFlags features_of(const Context& context, VkFormat format)
{
    VkFormatProperties properties = {};
    context.instance->table.GetPhysicalDeviceFormatProperties(context.physical.handle, format, &properties);
    return properties.optimalTilingFeatures;
}

void require_formats(const Context& context)
{
    constexpr VkFormatFeatureFlags depth_needs =
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    const bool fits = (features_of(context, kDepthFormat) & depth_needs) == depth_needs &&
                      (features_of(context, kColourFormat) & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) != 0;
    if (!fits)
        throw Error(ErrorCode::unsupported, context.physical.info.name +
                                                " cannot draw into 32-bit depth or 8-bit sRGB colour; "
                                                "draw on another Vulkan device");
}

} // namespace

DrawPipelines::DrawPipelines(std::shared_ptr<Context> context) : objects_(std::move(context))
{
    require_formats(*objects_.context());
    make_layouts();
    make_shadow_pass();
    make_picture_pass();
    make_pipelines();
}

void DrawPipelines::make_layouts()
{
    std::array<VkDescriptorSetLayoutBinding, kBindings> bindings = {};
    for (std::uint32_t i = 0; i < kBindings; ++i)
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    bindings[kShadowBinding].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    bindings[kShadowBinding].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    set_layout = objects_.set_layout(bindings);
    layout = objects_.pipeline_layout(set_layout, sizeof(DrawPush));
}

void DrawPipelines::make_shadow_pass()
{
    const VkAttachmentDescription map =
        attachment(kDepthFormat, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    const VkAttachmentReference depth = {0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.pDepthStencilAttachment = &depth;
    const VkSubpassDependency around[] = {
        dependency(VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, kDepthStages,
                   VK_ACCESS_SHADER_READ_BIT, kDepthAccess),
        dependency(0, VK_SUBPASS_EXTERNAL, kDepthStages, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                   VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT),
    };
    auto info = start<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &map;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = around;
    shadow_pass = objects_.render_pass(info);
    const VkExtent2D size = {kShadowSize, kShadowSize};
    shadow_map = objects_.image(kDepthFormat, size, VK_SAMPLE_COUNT_1_BIT,
                                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                VK_IMAGE_ASPECT_DEPTH_BIT);
    shadow_frame = objects_.framebuffer(shadow_pass, std::span(&shadow_map.view, 1), size);
    const VkFormatFeatureFlags features = features_of(*objects_.context(), kDepthFormat);
    sampler = objects_.shadow_sampler((features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0);
}

void DrawPipelines::make_picture_pass()
{
    std::array attachments = {
        attachment(kColourFormat, kSamples, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
        attachment(kDepthFormat, kSamples, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
        attachment(kColourFormat, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE,
                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
    };
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    const VkAttachmentReference colour = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolved = {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colour;
    subpass.pResolveAttachments = &resolved;
    subpass.pDepthStencilAttachment = &depth;
    constexpr VkPipelineStageFlags outputs = kDepthStages | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags writes =
        VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency around[] = {
        dependency(VK_SUBPASS_EXTERNAL, 0, outputs | VK_PIPELINE_STAGE_TRANSFER_BIT, outputs, writes,
                   writes | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT),
        dependency(0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                   VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                   VK_ACCESS_TRANSFER_READ_BIT),
    };
    auto info = start<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 3;
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 2;
    info.pDependencies = around;
    picture_pass = objects_.render_pass(info);
}

void DrawPipelines::make_pipelines()
{
    DrawObjects modules(objects_.context()); // needed only while pipelines are made
    const VkShaderModule surface_vertex = modules.shader(shaders::surface_vert);
    const VkShaderModule strand_vertex = modules.shader(shaders::strand_vert);
    const VkShaderModule shading = modules.shader(shaders::surface_frag);
    const Recipe sky = {modules.shader(shaders::background_vert), modules.shader(shaders::background_frag),
                        false, false};
    background = make_pipeline(objects_, layout, picture_pass, sky);
    surface[0] = make_pipeline(objects_, layout, picture_pass, {surface_vertex, shading, true, true});
    strand[0] = make_pipeline(objects_, layout, picture_pass, {strand_vertex, shading, false, true});
    surface[1] = make_pipeline(objects_, layout, shadow_pass, {surface_vertex, VK_NULL_HANDLE, true, true});
    strand[1] = make_pipeline(objects_, layout, shadow_pass, {strand_vertex, VK_NULL_HANDLE, false, true});
}

DrawTargets::DrawTargets(const DrawPipelines& pipelines, std::shared_ptr<Context> context, VkExtent2D extent)
    : objects(std::move(context)),
      size(extent)
{
    constexpr VkImageUsageFlags target = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    colour = objects.image(kColourFormat, size, kSamples, target, VK_IMAGE_ASPECT_COLOR_BIT);
    depth = objects.image(kDepthFormat, size, kSamples, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                          VK_IMAGE_ASPECT_DEPTH_BIT);
    resolved = objects.image(kColourFormat, size, VK_SAMPLE_COUNT_1_BIT,
                             target | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkImageView views[] = {colour.view, depth.view, resolved.view};
    frame = objects.framebuffer(pipelines.picture_pass, views, size);
}

} // namespace taut::vulkan
