#include "taut/runtime/vulkan/draw.hpp"

#include "taut/runtime/vulkan/draw_pipelines.hpp"
#include "taut/runtime/vulkan/structs.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <optional>

namespace taut {
namespace {

using vulkan::Context;
using vulkan::DrawFrame;
using vulkan::DrawPipelines;
using vulkan::DrawPush;
using vulkan::DrawTargets;
using vulkan::start;

float linear(float value)
{
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}
glm::vec4 linear(const glm::vec3& c, float w) { return {linear(c.x), linear(c.y), linear(c.z), w}; }

constexpr std::uint32_t kStrandFinish = 3; // kStrand of shaders/frame.glsl

/// Empty when `context` draws, else why not.
std::string why_not(const Context& context)
{
    if ((context.physical.family.queueFlags & VK_QUEUE_GRAPHICS_BIT) == 0)
        return context.physical.info.name + " has no queue that both computes and draws; draw on another "
                                            "Vulkan device";
    return {};
}

DrawFrame frame_of(const Shot& shot)
{
    const Camera& camera = shot.camera;
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::normalize(camera.up);
    const glm::vec3 to_light = glm::normalize(up - 0.75f * right - 0.25f * forward);
    const float distance = glm::length(shot.focus - camera.eye);
    const float aspect = static_cast<float>(shot.width) / static_cast<float>(shot.height);
    const float r = shot.radius;
    DrawFrame out = {};
    out.view[0] = glm::perspectiveRH_ZO(camera.fov, aspect, 0.02f * (distance + r), distance + 40 * r) *
                  glm::lookAtRH(camera.eye, camera.target, camera.up);
    out.view[1] = glm::orthoRH_ZO(-r, r, -r, r, 0.0f, 4 * r) *
                  glm::lookAtRH(shot.focus + 2 * r * to_light, shot.focus, right);
    for (int i = 0; i < 4; ++i)
        out.view[0][i][1] = -out.view[0][i][1]; // Vulkan's y points down
    out.eye = glm::vec4(camera.eye, 1);
    out.to_light = glm::vec4(to_light, 0);
    out.up = glm::vec4(up, 0);
    out.focus = glm::vec4(shot.focus, r);
    out.sky_top = linear(shot.sky_top, static_cast<float>(shot.height));
    out.sky_bottom = linear(shot.sky_bottom, 0);
    return out;
}

/// For each vertex, the two other corners of each triangle around it, in compressed rows.
struct Around
{
    std::vector<std::uint32_t> first, corners;

    Around(std::span<const std::uint32_t> triangles, std::size_t vertices)
        : first(vertices + 1),
          corners(2 * triangles.size())
    {
        for (const std::uint32_t v : triangles)
            ++first[v + 1];
        for (std::size_t v = 0; v < vertices; ++v)
            first[v + 1] += first[v];
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::size_t t = 0; t < triangles.size(); t += 3)
            for (std::size_t k = 0; k < 3; ++k)
            {
                const std::size_t at = 2 * std::size_t(next[triangles[t + k]]++);
                corners[at] = triangles[t + (k + 1) % 3];
                corners[at + 1] = triangles[t + (k + 2) % 3];
            }
    }
};

void check_indices(const std::vector<std::uint32_t>& list, std::size_t group, std::size_t vertices,
                   const char* what)
{
    if (list.size() % group != 0)
        throw Error(ErrorCode::bad_input, std::string("Surface::") + what + " has " +
                                              std::to_string(list.size()) + " entries, not a multiple of " +
                                              std::to_string(group));
    for (const std::uint32_t v : list)
        if (v >= vertices)
            throw Error(ErrorCode::bad_input, std::string("Surface::") + what + " names vertex " +
                                                  std::to_string(v) + " of " + std::to_string(vertices));
}

/// A surface on the device.
struct Prepared
{
    BufferPtr positions, first, around, indices, lines;
    std::uint32_t index_count = 0, strand_vertices = 0;
    VkDescriptorSet set = VK_NULL_HANDLE;
    DrawPush push;
    float line_radius = 0;
    bool casts = true;
};

} // namespace

struct Renderer::Impl
{
    std::shared_ptr<Device> device;
    std::shared_ptr<Context> context;
    std::optional<DrawPipelines> pipelines;
    std::optional<DrawTargets> targets;
    BufferPtr frame, pixels;

    template <typename T>
    BufferPtr upload(const std::vector<T>& values, std::string_view label)
    {
        // A binding needs a buffer even where there is nothing to read.
        BufferPtr buffer = device->make_buffer(std::max<std::size_t>(values.size() * sizeof(T), 16), label);
        if (!values.empty())
            device->write<T>(buffer, values);
        return buffer;
    }

    void resize(const Shot& shot)
    {
        const std::uint32_t largest = context->physical.properties.limits.maxFramebufferWidth;
        if (shot.width == 0 || shot.height == 0 || !(shot.radius > 0))
            throw Error(ErrorCode::bad_input, "a picture needs a width, a height and a radius above 0");
        if (std::max(shot.width, shot.height) > largest)
            throw Error(ErrorCode::limit, "a picture of " + std::to_string(shot.width) + " x " +
                                              std::to_string(shot.height) + " pixels exceeds the " +
                                              std::to_string(largest) + " of " + device->info().name);
        if (targets && targets->size.width == shot.width && targets->size.height == shot.height)
            return;
        targets.reset();
        targets.emplace(*pipelines, context, VkExtent2D{shot.width, shot.height});
        pixels = device->make_buffer(std::uint64_t(4) * shot.width * shot.height, "picture");
    }

    Prepared prepare(const Surface& surface)
    {
        Prepared out;
        out.positions = surface.buffer ? surface.buffer : upload(surface.positions, "drawn positions");
        const std::size_t vertices =
            surface.buffer ? surface.buffer->bytes() / sizeof(glm::vec4) : surface.positions.size();
        if (vulkan::vulkan_buffer_of(out.positions).context != context)
            throw Error(ErrorCode::bad_input, "Surface::buffer belongs to another device than the Renderer");
        check_indices(surface.triangles, 3, vertices, "triangles");
        check_indices(surface.lines, 2, vertices, "lines");
        const Around around(surface.triangles, vertices);
        out.first = upload(around.first, "first triangles");
        out.around = upload(around.corners, "triangles around");
        out.indices = upload(surface.triangles, "triangles");
        out.lines = upload(surface.lines, "lines");
        out.index_count = static_cast<std::uint32_t>(surface.triangles.size());
        out.strand_vertices = static_cast<std::uint32_t>(surface.lines.size() / 2 * 6);
        out.push.front = linear(surface.front, surface.cell);
        out.push.back = linear(surface.back, 0);
        out.push.finish = static_cast<std::uint32_t>(surface.finish);
        out.line_radius = surface.line_radius;
        out.casts = surface.finish != Finish::ground;
        return out;
    }

    void describe(Prepared& surface, VkDescriptorPool pool)
    {
        auto info = start<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
        info.descriptorPool = pool;
        info.descriptorSetCount = 1;
        info.pSetLayouts = &pipelines->set_layout;
        context->health.check(context->vk.vkAllocateDescriptorSets(context->device, &info, &surface.set),
                              "vkAllocateDescriptorSets");
        const VkDescriptorImageInfo map = {pipelines->sampler, pipelines->shadow_map.view,
                                           VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL};
        const BufferPtr* const buffers[] = {&frame,         nullptr,         &surface.positions,
                                            &surface.first, &surface.around, &surface.lines};
        std::array<VkDescriptorBufferInfo, DrawPipelines::kBindings> infos = {};
        std::array<VkWriteDescriptorSet, DrawPipelines::kBindings> writes = {};
        for (std::uint32_t i = 0; i < DrawPipelines::kBindings; ++i)
        {
            writes[i] = start<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
            writes[i].dstSet = surface.set;
            writes[i].dstBinding = i;
            writes[i].descriptorCount = 1;
            writes[i].descriptorType = i == DrawPipelines::kShadowBinding
                                           ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                           : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            if (i == DrawPipelines::kShadowBinding)
                writes[i].pImageInfo = &map;
            else
            {
                infos[i] = {vulkan::vulkan_buffer_of(*buffers[i]).handle, 0, VK_WHOLE_SIZE};
                writes[i].pBufferInfo = &infos[i];
            }
        }
        context->vk.vkUpdateDescriptorSets(context->device, DrawPipelines::kBindings, writes.data(), 0,
                                           nullptr);
    }

    void push(VkCommandBuffer commands, const DrawPush& values) const
    {
        context->vk.vkCmdPushConstants(commands, pipelines->layout,
                                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                       sizeof values, &values);
    }

    void draw_surface(VkCommandBuffer commands, const Prepared& surface, std::uint32_t pass) const
    {
        const VolkDeviceTable& vk = context->vk;
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->layout, 0, 1,
                                   &surface.set, 0, nullptr);
        DrawPush values = surface.push;
        values.pass = pass;
        if (surface.index_count > 0)
        {
            const VkBuffer positions = vulkan::vulkan_buffer_of(surface.positions).handle;
            const VkDeviceSize offset = 0;
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->surface[pass]);
            vk.vkCmdBindVertexBuffers(commands, 0, 1, &positions, &offset);
            vk.vkCmdBindIndexBuffer(commands, vulkan::vulkan_buffer_of(surface.indices).handle, 0,
                                    VK_INDEX_TYPE_UINT32);
            push(commands, values);
            vk.vkCmdDrawIndexed(commands, surface.index_count, 1, 0, 0, 0);
        }
        if (surface.strand_vertices > 0)
        {
            values.front.w = surface.line_radius;
            values.finish = kStrandFinish;
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->strand[pass]);
            push(commands, values);
            vk.vkCmdDraw(commands, surface.strand_vertices, 1, 0, 0);
        }
    }

    void begin(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer target, VkExtent2D size) const
    {
        std::array<VkClearValue, 3> clear = {};
        const bool shadow = pass == pipelines->shadow_pass;
        clear[shadow ? 0 : 1].depthStencil = {1.0f, 0};
        auto info = start<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        info.renderPass = pass;
        info.framebuffer = target;
        info.renderArea = {{0, 0}, size};
        info.clearValueCount = shadow ? 1 : 2;
        info.pClearValues = clear.data();
        const VkViewport viewport = {0, 0, static_cast<float>(size.width), static_cast<float>(size.height),
                                     0, 1};
        context->vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
        context->vk.vkCmdSetViewport(commands, 0, 1, &viewport);
        context->vk.vkCmdSetScissor(commands, 0, 1, &info.renderArea);
    }

    /// surfaces[0] is empty; its set serves the background.
    void record(VkCommandBuffer commands, const std::vector<Prepared>& surfaces) const
    {
        const VolkDeviceTable& vk = context->vk;
        begin(commands, pipelines->shadow_pass, pipelines->shadow_frame,
              {vulkan::kShadowSize, vulkan::kShadowSize});
        for (const Prepared& surface : surfaces)
            if (surface.casts)
                draw_surface(commands, surface, 1);
        vk.vkCmdEndRenderPass(commands);

        begin(commands, pipelines->picture_pass, targets->frame, targets->size);
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->background);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines->layout, 0, 1,
                                   &surfaces.front().set, 0, nullptr);
        vk.vkCmdDraw(commands, 3, 1, 0, 0);
        for (const Prepared& surface : surfaces)
            draw_surface(commands, surface, 0);
        vk.vkCmdEndRenderPass(commands);

        VkBufferImageCopy region = {};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {targets->size.width, targets->size.height, 1};
        vk.vkCmdCopyImageToBuffer(commands, targets->resolved.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                  vulkan::vulkan_buffer_of(pixels).handle, 1, &region);
    }
};

Renderer::Renderer(std::shared_ptr<Device> device) : impl_(std::make_unique<Impl>())
{
    impl_->context = vulkan::context_of(*device);
    impl_->device = std::move(device);
    const std::string reason = why_not(*impl_->context);
    if (!reason.empty())
        throw Error(ErrorCode::unsupported, reason);
    impl_->pipelines.emplace(impl_->context);
    impl_->frame = impl_->device->make_buffer(sizeof(DrawFrame), "frame");
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const std::shared_ptr<Device>& Renderer::device() const { return impl_->device; }

Image Renderer::draw(const Shot& shot, std::span<const Surface> surfaces)
{
    impl_->resize(shot);
    const DrawFrame frame = frame_of(shot);
    impl_->device->write(impl_->frame, 0, std::as_bytes(std::span(&frame, 1)));
    vulkan::DrawObjects objects(impl_->context);
    const VkDescriptorPool pool = objects.descriptor_pool(static_cast<std::uint32_t>(surfaces.size() + 1),
                                                          DrawPipelines::kBindings - 1);
    std::vector<Prepared> prepared = {impl_->prepare({})};
    for (const Surface& surface : surfaces)
        prepared.push_back(impl_->prepare(surface));
    for (Prepared& surface : prepared)
        impl_->describe(surface, pool);
    impl_->context->transfer->run([&](VkCommandBuffer commands) { impl_->record(commands, prepared); });
    Image image = {shot.width, shot.height, {}};
    image.rgba = impl_->device->read<std::uint8_t>(impl_->pixels, impl_->pixels->bytes());
    return image;
}

bool can_draw(const Device& device)
{
    return device.info().executor == "vulkan" && why_not(*vulkan::context_of(device)).empty();
}

std::shared_ptr<Device> open_drawing_device(const OpenOptions& options)
{
    const std::size_t count = list_vulkan().size();
    std::string reason;
    for (std::size_t i = 0; i < count; ++i)
    {
        const std::shared_ptr<Device> device = open_vulkan(i, options);
        reason = why_not(*vulkan::context_of(*device));
        if (reason.empty())
            return device;
    }
    if (count == 0)
        return open_vulkan(0, options); // says why there is none
    throw Error(ErrorCode::no_device, reason);
}

} // namespace taut
