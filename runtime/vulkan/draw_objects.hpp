#pragma once
// Internal: Vulkan objects of a renderer, destroyed together in reverse order.

#include "taut/runtime/vulkan/context.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <functional>
#include <span>
#include <vector>

namespace taut::vulkan {

inline constexpr VkFormat kColourFormat = VK_FORMAT_R8G8B8A8_SRGB;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkSampleCountFlagBits kSamples = VK_SAMPLE_COUNT_4_BIT;
inline constexpr std::uint32_t kShadowSize = 1536; ///< pixels, each way

/// FrameBlock of shaders/frame.glsl.
struct DrawFrame
{
    glm::mat4 view[2];
    glm::vec4 eye, to_light, up, focus, sky_top, sky_bottom;
};
static_assert(sizeof(DrawFrame) == 224);

/// PushBlock of shaders/frame.glsl.
struct DrawPush
{
    glm::vec4 front, back;
    std::uint32_t pass = 0;
    std::uint32_t finish = 0;
};
static_assert(sizeof(DrawPush) == 40);

struct DrawImage
{
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

/// Makes objects and owns them.
class DrawObjects
{
public:
    explicit DrawObjects(std::shared_ptr<Context> context) : context_(std::move(context)) {}
    DrawObjects(const DrawObjects&) = delete;
    DrawObjects& operator=(const DrawObjects&) = delete;
    ~DrawObjects();

    /// In memory of its own; throws Error{out_of_memory}.
    DrawImage image(VkFormat format, VkExtent2D size, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                    VkImageAspectFlags aspect);
    VkSampler shadow_sampler(bool linear);
    VkDescriptorSetLayout set_layout(std::span<const VkDescriptorSetLayoutBinding> bindings);
    VkPipelineLayout pipeline_layout(VkDescriptorSetLayout set, std::uint32_t push_bytes);
    VkDescriptorPool descriptor_pool(std::uint32_t sets, std::uint32_t buffers_per_set);
    VkRenderPass render_pass(const VkRenderPassCreateInfo& info);
    VkFramebuffer framebuffer(VkRenderPass pass, std::span<const VkImageView> views, VkExtent2D size);
    VkShaderModule shader(std::span<const std::uint32_t> spirv);
    VkPipeline pipeline(const VkGraphicsPipelineCreateInfo& info);

    const std::shared_ptr<Context>& context() const { return context_; }

private:
    VkDeviceMemory image_memory(VkImage image);

    std::shared_ptr<Context> context_;
    std::vector<std::function<void()>> destroy_;
};

} // namespace taut::vulkan
