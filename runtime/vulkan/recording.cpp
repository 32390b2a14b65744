#include "taut/runtime/vulkan/recording.hpp"

#include "taut/runtime/limits.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <cassert>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace taut::vulkan {
namespace {

constexpr VkPipelineStageFlags kCompute = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags kIndirect = VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT;
constexpr VkAccessFlags kShader = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;

/// Bindings of one dispatch as bytes: the key under which descriptor sets are shared.
std::string_view key_of(const std::vector<BufferRange>& bindings, std::vector<std::uint64_t>& scratch)
{
    scratch.clear();
    for (const BufferRange& range : bindings)
        scratch.insert(scratch.end(), {range.buffer, range.offset, range.bytes});
    return {reinterpret_cast<const char*>(scratch.data()), scratch.size() * sizeof(std::uint64_t)};
}

} // namespace

VulkanRecording::VulkanRecording(std::shared_ptr<Context> context, RecordingDesc desc)
    : context_(std::move(context)),
      buffers_(std::move(desc.buffers))
{
    assert(desc.dispatches.size() == desc.barrier_before.size());
    dispatches_ = std::move(desc.dispatches);
    barrier_before_ = std::move(desc.barrier_before);
    handles_.reserve(buffers_.size());
    for (const BufferPtr& buffer : buffers_)
        handles_.push_back(vulkan_buffer_of(buffer).handle);
    try
    {
        build();
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

void VulkanRecording::build()
{
    context_->health.require_alive();
    make_pool();
    make_steps();
    make_sets();
    record_copy(copies_[0]);
}

VulkanRecording::~VulkanRecording()
{
    try
    {
        context_->queue->wait(last_submission_);
    }
    catch (const Error&)
    {
        // The device is lost: nothing runs any more, and destroying is all that is left.
    }
    destroy();
}

void VulkanRecording::destroy()
{
    const VolkDeviceTable& vk = context_->vk;
    for (const VkQueryPool pool : query_pools_)
        vk.vkDestroyQueryPool(context_->device, pool, nullptr);
    vk.vkDestroyCommandPool(context_->device, pool_, nullptr);
    vk.vkDestroyDescriptorPool(context_->device, descriptors_, nullptr);
}

void VulkanRecording::make_pool()
{
    auto info = start<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    info.queueFamilyIndex = context_->physical.queue_family;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    context_->health.check(context_->vk.vkCreateCommandPool(context_->device, &info, nullptr, &pool_),
                           "vkCreateCommandPool");
}

void VulkanRecording::make_steps()
{
    std::unordered_map<const KernelInfo*, Pipeline> pipelines;
    const std::uint32_t most_groups = context_->physical.info.limits.max_groups_per_dimension;
    steps_.resize(dispatches_.size());
    bool indirect_follows = false;
    for (std::size_t i = dispatches_.size(); i-- > 0;)
    {
        const Dispatch& dispatch = dispatches_[i];
        Step& step = steps_[i];
        auto [found, is_new] = pipelines.try_emplace(dispatch.kernel);
        if (is_new)
            found->second = context_->pipelines->get(*dispatch.kernel);
        step.pipeline = found->second;
        if (dispatch.indirect.buffer != kNoBuffer)
        {
            step.indirect = handles_[dispatch.indirect.buffer];
            step.indirect_offset = dispatch.indirect.offset;
            indirect_follows = true;
        }
        else
        {
            const GroupFold fold = fold_groups(group_count(*dispatch.kernel, dispatch.count), most_groups);
            step.groups_x = fold.x;
            step.groups_y = fold.y;
        }
        step.barrier = barrier_before_[i];
        step.indirect_follows = indirect_follows;
        if (step.barrier)
            indirect_follows = false;
    }
}

void VulkanRecording::make_sets()
{
    std::unordered_map<std::string, std::size_t> known;
    std::vector<std::size_t> set_of(dispatches_.size());
    std::vector<std::size_t> first_user;
    std::vector<std::uint64_t> scratch;
    for (std::size_t i = 0; i < dispatches_.size(); ++i)
    {
        const auto [it, is_new] =
            known.try_emplace(std::string(key_of(dispatches_[i].bindings, scratch)), first_user.size());
        if (is_new)
            first_user.push_back(i);
        set_of[i] = it->second;
    }
    write_sets(set_of, first_user);
}

void VulkanRecording::write_sets(const std::vector<std::size_t>& set_of,
                                 const std::vector<std::size_t>& first_user)
{
    std::vector<VkDescriptorSetLayout> layouts;
    std::vector<VkDescriptorBufferInfo> ranges;
    for (const std::size_t user : first_user)
        if (steps_[user].pipeline.set_layout != VK_NULL_HANDLE)
        {
            layouts.push_back(steps_[user].pipeline.set_layout);
            for (const BufferRange& range : dispatches_[user].bindings)
                ranges.push_back({handles_[range.buffer], range.offset, range.bytes});
        }
    if (layouts.empty())
        return;

    const VolkDeviceTable& vk = context_->vk;
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                       static_cast<std::uint32_t>(ranges.size())};
    auto pool = start<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = static_cast<std::uint32_t>(layouts.size());
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    context_->health.check(vk.vkCreateDescriptorPool(context_->device, &pool, nullptr, &descriptors_),
                           "vkCreateDescriptorPool");
    auto info = start<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    info.descriptorPool = descriptors_;
    info.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
    info.pSetLayouts = layouts.data();
    std::vector<VkDescriptorSet> allocated(layouts.size());
    context_->health.check(vk.vkAllocateDescriptorSets(context_->device, &info, allocated.data()),
                           "vkAllocateDescriptorSets");

    std::vector<VkDescriptorSet> sets(first_user.size(), VK_NULL_HANDLE);
    std::vector<VkWriteDescriptorSet> writes;
    const VkDescriptorBufferInfo* range = ranges.data();
    std::size_t used = 0;
    for (std::size_t s = 0; s < first_user.size(); ++s)
    {
        if (steps_[first_user[s]].pipeline.set_layout == VK_NULL_HANDLE)
            continue;
        sets[s] = allocated[used++];
        auto write = start<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstSet = sets[s];
        // Bindings without gaps, of one type: one write runs over all of them.
        write.descriptorCount = static_cast<std::uint32_t>(dispatches_[first_user[s]].bindings.size());
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = range;
        range += write.descriptorCount;
        writes.push_back(write);
    }
    vk.vkUpdateDescriptorSets(context_->device, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                              nullptr);
    for (std::size_t i = 0; i < steps_.size(); ++i)
        steps_[i].set = sets[set_of[i]];
}

VkCommandBuffer VulkanRecording::new_commands()
{
    auto info = start<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    info.commandPool = pool_;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    const VolkDeviceTable& vk = context_->vk;
    context_->health.check(vk.vkAllocateCommandBuffers(context_->device, &info, &commands),
                           "vkAllocateCommandBuffers");
    return commands;
}

void VulkanRecording::begin(VkCommandBuffer commands)
{
    const auto info = start<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    context_->health.check(context_->vk.vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

void VulkanRecording::opening_barrier(VkCommandBuffer commands) const
{
    // Whatever the queue did before: the last replay, an upload, a host's drawing.
    auto memory = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT;
    memory.dstAccessMask = kShader | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    context_->vk.vkCmdPipelineBarrier(commands,
                                      VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT,
                                      kCompute | kIndirect, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void VulkanRecording::closing_barrier(VkCommandBuffer commands) const
{
    auto memory = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    context_->vk.vkCmdPipelineBarrier(commands, kCompute,
                                      VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                      &memory, 0, nullptr, 0, nullptr);
}

void VulkanRecording::barrier(VkCommandBuffer commands, const Step& step) const
{
    auto memory = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    memory.dstAccessMask = kShader;
    VkPipelineStageFlags to = kCompute;
    if (step.indirect_follows)
    {
        memory.dstAccessMask |= VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
        to |= kIndirect;
    }
    context_->vk.vkCmdPipelineBarrier(commands, kCompute, to, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void VulkanRecording::record_step(VkCommandBuffer commands, std::size_t index, const Step* previous)
{
    const VolkDeviceTable& vk = context_->vk;
    const Step& step = steps_[index];
    if (previous == nullptr || previous->pipeline.handle != step.pipeline.handle)
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, step.pipeline.handle);
    if (step.set != VK_NULL_HANDLE && (previous == nullptr || previous->set != step.set))
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, step.pipeline.layout, 0, 1,
                                   &step.set, 0, nullptr);
    const std::vector<std::byte>& params = dispatches_[index].params;
    if (!params.empty())
        vk.vkCmdPushConstants(commands, step.pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                              static_cast<std::uint32_t>(params.size()), params.data());
    if (step.indirect != VK_NULL_HANDLE)
        vk.vkCmdDispatchIndirect(commands, step.indirect, step.indirect_offset);
    else
        vk.vkCmdDispatch(commands, step.groups_x, step.groups_y, 1);
}

void VulkanRecording::record_steps(VkCommandBuffer commands)
{
    opening_barrier(commands);
    const Step* previous = nullptr;
    for (std::size_t i = 0; i < steps_.size(); ++i)
    {
        if (steps_[i].barrier)
            barrier(commands, steps_[i]);
        record_step(commands, i, previous);
        previous = &steps_[i];
    }
    closing_barrier(commands);
}

void VulkanRecording::record_copy(Copy& copy)
{
    copy.commands = new_commands();
    begin(copy.commands);
    record_steps(copy.commands);
    context_->health.check(context_->vk.vkEndCommandBuffer(copy.commands), "vkEndCommandBuffer");
}

void VulkanRecording::record_writes(Copy& copy, std::span<const BufferWrite> writes)
{
    if (copy.writes == VK_NULL_HANDLE)
        copy.writes = new_commands();
    begin(copy.writes);
    record_writes(copy.writes, writes);
    context_->health.check(context_->vk.vkEndCommandBuffer(copy.writes), "vkEndCommandBuffer");
}

void VulkanRecording::count_work()
{
    context_->dispatches += dispatches_.size();
    context_->barriers += barrier_count();
}

void VulkanRecording::replay(std::span<const BufferWrite> writes)
{
    const std::lock_guard lock(mutex_);
    context_->health.require_alive();
    Copy& copy = copies_[next_copy_];
    if (copy.commands == VK_NULL_HANDLE)
        record_copy(copy);
    context_->queue->wait(copy.submission);
    if (!writes.empty())
        record_writes(copy, writes);
    const VkCommandBuffer both[] = {copy.writes, copy.commands};
    copy.submission = context_->queue->submit(std::span(both).subspan(writes.empty() ? 1 : 0));
    last_submission_ = copy.submission;
    next_copy_ = (next_copy_ + 1) % copies_.size();
    count_work();
}

void VulkanRecording::record_writes(VkCommandBuffer commands, std::span<const BufferWrite> writes) const
{
    constexpr std::size_t kMostBytes = 65536; // of one vkCmdUpdateBuffer
    if (writes.empty())
        return;
    // A step that is still running may read what is about to be written.
    auto memory = start<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    memory.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_WRITE_BIT;
    memory.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    context_->vk.vkCmdPipelineBarrier(commands,
                                      VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT,
                                      VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
    for (const BufferWrite& write : writes)
        for (std::size_t at = 0; at < write.bytes.size(); at += kMostBytes)
        {
            const auto part = write.bytes.subspan(at, std::min(kMostBytes, write.bytes.size() - at));
            context_->vk.vkCmdUpdateBuffer(commands, vulkan_buffer_of(write.buffer).handle, write.offset + at,
                                           part.size(), part.data());
        }
}

void VulkanRecording::record_into(VkCommandBuffer commands, std::span<const BufferWrite> writes)
{
    const std::lock_guard lock(mutex_);
    context_->health.require_alive();
    record_writes(commands, writes);
    record_steps(commands);
    count_work();
}

} // namespace taut::vulkan
