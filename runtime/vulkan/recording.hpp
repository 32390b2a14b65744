#pragma once
// A recording as Vulkan commands, written once and submitted as often as asked.

#include "taut/runtime/vulkan/context.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <array>
#include <mutex>
#include <vector>

namespace taut::vulkan {

class VulkanRecording final : public Recording
{
public:
    VulkanRecording(std::shared_ptr<Context> context, RecordingDesc desc);
    ~VulkanRecording() override;

    void replay() override { replay({}); }
    /// `writes` are put into the same submission, before the list.
    void replay(std::span<const BufferWrite> writes);
    std::vector<DispatchTime> replay_timed() override;

    /// Writes the whole list, with barriers against everything before and after, into a host's commands.
    void record_into(VkCommandBuffer commands, std::span<const BufferWrite> writes);

private:
    /// What one dispatch needs at recording time, looked up once.
    struct Step
    {
        Pipeline pipeline;
        VkDescriptorSet set = VK_NULL_HANDLE;
        std::uint32_t groups_x = 0;
        std::uint32_t groups_y = 0;
        VkBuffer indirect = VK_NULL_HANDLE;
        VkDeviceSize indirect_offset = 0;
        bool barrier = false;
        bool indirect_follows = false; ///< an indirect dispatch stands between this barrier and the next
    };

    /// Command buffers and the submission that last used them.
    struct Copy
    {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkCommandBuffer writes = VK_NULL_HANDLE; ///< recorded anew for each replay that has any
        std::uint64_t submission = 0;
    };

    void build();
    void make_steps();
    void make_sets();
    void write_sets(const std::vector<std::size_t>& set_of, const std::vector<std::size_t>& first_user);
    void make_pool();
    void destroy();
    void record_copy(Copy& copy);
    void record_writes(Copy& copy, std::span<const BufferWrite> writes);
    VkCommandBuffer new_commands();
    void begin(VkCommandBuffer commands);
    void record_writes(VkCommandBuffer commands, std::span<const BufferWrite> writes) const;
    void record_steps(VkCommandBuffer commands);
    void record_timed();
    void make_query_pools();
    void record_step(VkCommandBuffer commands, std::size_t index, const Step* previous);
    void barrier(VkCommandBuffer commands, const Step& step) const;
    void opening_barrier(VkCommandBuffer commands) const;
    void closing_barrier(VkCommandBuffer commands) const;
    std::vector<std::uint64_t> read_timestamps() const;
    void count_work();

    std::shared_ptr<Context> context_;
    std::vector<BufferPtr> buffers_;
    std::vector<VkBuffer> handles_;
    std::vector<Step> steps_;
    std::mutex mutex_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
    // Two, so that the host can submit a step while the last one runs, without the flag for simultaneous use.
    std::array<Copy, 2> copies_;
    std::size_t next_copy_ = 0;
    VkCommandBuffer timed_ = VK_NULL_HANDLE;
    std::vector<VkQueryPool> query_pools_;
    std::uint64_t last_submission_ = 0;
};

} // namespace taut::vulkan
