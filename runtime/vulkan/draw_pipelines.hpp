#pragma once
// Internal: render passes, pipelines and targets of a renderer.

#include "taut/runtime/vulkan/draw_objects.hpp"

namespace taut::vulkan {

/// Everything that does not depend on the size of a picture.
class DrawPipelines
{
public:
    /// Bindings of set 0: the frame, the shadow map, positions, first, around, lines.
    static constexpr std::uint32_t kBindings = 6;
    static constexpr std::uint32_t kShadowBinding = 1;

    /// Throws Error{unsupported} when a format lacks what drawing needs.
    explicit DrawPipelines(std::shared_ptr<Context> context);

    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkRenderPass shadow_pass = VK_NULL_HANDLE, picture_pass = VK_NULL_HANDLE;
    VkPipeline background = VK_NULL_HANDLE;
    VkPipeline surface[2] = {}, strand[2] = {}; ///< 0: into the picture, 1: into the shadow map
    VkSampler sampler = VK_NULL_HANDLE;
    DrawImage shadow_map;
    VkFramebuffer shadow_frame = VK_NULL_HANDLE;

private:
    void make_layouts();
    void make_shadow_pass();
    void make_picture_pass();
    void make_pipelines();

    DrawObjects objects_;
};

/// Images of one size.
struct DrawTargets
{
    DrawTargets(const DrawPipelines& pipelines, std::shared_ptr<Context> context, VkExtent2D extent);

    DrawObjects objects;
    VkExtent2D size;
    DrawImage colour, depth, resolved;
    VkFramebuffer frame = VK_NULL_HANDLE;
};

} // namespace taut::vulkan
