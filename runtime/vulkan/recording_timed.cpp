// The timed form of a recording: the same commands with a pair of timestamps around every dispatch.

#include "taut/runtime/vulkan/recording.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>

namespace taut::vulkan {
namespace {

constexpr std::uint32_t kQueriesPerPool = 8192; // even: a pair never straddles two pools

} // namespace

void VulkanRecording::make_query_pools()
{
    const std::size_t queries = 2 * steps_.size();
    for (std::size_t done = 0; done < queries; done += kQueriesPerPool)
    {
        auto info = start<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = static_cast<std::uint32_t>(std::min<std::size_t>(queries - done, kQueriesPerPool));
        VkQueryPool pool = VK_NULL_HANDLE;
        context_->health.check(context_->vk.vkCreateQueryPool(context_->device, &info, nullptr, &pool),
                               "vkCreateQueryPool");
        query_pools_.push_back(pool);
    }
}

void VulkanRecording::record_timed()
{
    const VolkDeviceTable& vk = context_->vk;
    const auto pool_of = [&](std::size_t query) { return query_pools_[query / kQueriesPerPool]; };
    const auto index_of = [&](std::size_t query) {
        return static_cast<std::uint32_t>(query % kQueriesPerPool);
    };
    if (query_pools_.empty())
        make_query_pools();
    const VkCommandBuffer commands = new_commands();
    begin(commands);
    for (std::size_t p = 0; p < query_pools_.size(); ++p)
    {
        const std::size_t left = 2 * steps_.size() - p * kQueriesPerPool;
        vk.vkCmdResetQueryPool(commands, query_pools_[p], 0,
                               static_cast<std::uint32_t>(std::min<std::size_t>(left, kQueriesPerPool)));
    }
    opening_barrier(commands);
    const Step* previous = nullptr;
    for (std::size_t i = 0; i < steps_.size(); ++i)
    {
        // Both stamps wait for all commands before them, and the barrier stands between them: the times
        // of a list add up to the time of the list.
        vk.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_of(2 * i),
                               index_of(2 * i));
        if (steps_[i].barrier)
            barrier(commands, steps_[i]);
        record_step(commands, i, previous);
        vk.vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_of(2 * i + 1),
                               index_of(2 * i + 1));
        previous = &steps_[i];
    }
    closing_barrier(commands);
    context_->health.check(vk.vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    timed_ = commands;
}

std::vector<std::uint64_t> VulkanRecording::read_timestamps() const
{
    std::vector<std::uint64_t> stamps(2 * steps_.size());
    for (std::size_t p = 0; p < query_pools_.size(); ++p)
    {
        const std::size_t first = p * kQueriesPerPool;
        const std::size_t count = std::min<std::size_t>(stamps.size() - first, kQueriesPerPool);
        context_->health.check(context_->vk.vkGetQueryPoolResults(
                                   context_->device, query_pools_[p], 0, static_cast<std::uint32_t>(count),
                                   count * sizeof(std::uint64_t), stamps.data() + first,
                                   sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                               "vkGetQueryPoolResults");
    }
    return stamps;
}

std::vector<DispatchTime> VulkanRecording::replay_timed()
{
    const std::lock_guard lock(mutex_);
    context_->health.require_alive();
    const std::uint32_t bits = context_->physical.family.timestampValidBits;
    const double period = static_cast<double>(context_->physical.properties.limits.timestampPeriod);
    if (bits == 0 || period <= 0)
        throw Error(ErrorCode::unsupported,
                    context_->physical.info.name +
                        " has no timestamps on its compute queue (timestampValidBits = 0); "
                        "time whole steps with Device::wait instead");
    if (timed_ == VK_NULL_HANDLE)
        record_timed();
    last_submission_ = context_->queue->submit(timed_);
    context_->queue->wait(last_submission_);
    count_work();

    const std::vector<std::uint64_t> stamps = read_timestamps();
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    std::vector<DispatchTime> times(steps_.size());
    for (std::size_t i = 0; i < times.size(); ++i)
        times[i] = {i, static_cast<double>((stamps[2 * i + 1] - stamps[2 * i]) & mask) * period};
    return times;
}

} // namespace taut::vulkan
