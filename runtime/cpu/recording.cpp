#include "taut/runtime/cpu/recording.hpp"

#include "taut/runtime/base/flush_denormals.hpp"

#include <cassert>
#include <chrono>
#include <utility>

namespace taut::cpu {
namespace {

using Clock = std::chrono::steady_clock;

double nanoseconds_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

void check_owner(const BufferPtr& buffer, std::size_t index, const Stats* owner)
{
    const auto* mine = dynamic_cast<const CpuBuffer*>(buffer.get());
    if (!mine || mine->owner() != owner)
        throw Error(ErrorCode::bad_input,
                    "buffer " + std::to_string(index) + " of the list was not made by this device");
}

} // namespace

CpuRecording::CpuRecording(RecordingDesc desc, std::shared_ptr<Engine> engine)
    : engine_(std::move(engine)),
      buffers_(std::move(desc.buffers))
{
    dispatches_ = std::move(desc.dispatches);
    barrier_before_ = std::move(desc.barrier_before);
    for (std::size_t i = 0; i < buffers_.size(); ++i)
        check_owner(buffers_[i], i, engine_->stats.get());
    passes_.reserve(dispatches_.size());
    for (std::size_t i = 0; i < dispatches_.size(); ++i)
    {
        if (i > 0 && barrier_before_[i])
            section_ends_.push_back(i);
        passes_.push_back(make_pass(dispatches_[i]));
    }
    section_ends_.push_back(passes_.size());
}

std::byte* CpuRecording::address(const BufferRange& range) const
{
    return static_cast<const CpuBuffer&>(*buffers_[range.buffer]).data() + range.offset;
}

Pass CpuRecording::make_pass(const Dispatch& dispatch) const
{
    const KernelInfo& kernel = *dispatch.kernel;
    if (!kernel.native)
        throw Error(
            ErrorCode::unsupported,
            "kernel \"" + std::string(kernel.name) +
                "\" has no native code, since it was compiled at run time: use a vulkan or opengl device");
    assert(dispatch.bindings.size() <= kMaxBindings);
    Pass pass;
    pass.native = kernel.native;
    pass.params = dispatch.params.data();
    for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
        pass.buffers[i] = address(dispatch.bindings[i]);
    pass.count = dispatch.count;
    pass.per_group = kernel.group_kernel ? 1 : kernel.group_size;
    pass.cost = ElementCost(kernel.group_kernel ? 10.0 * kernel.group_size : 10.0);
    if (dispatch.indirect.buffer != kNoBuffer)
        pass.indirect = reinterpret_cast<const std::uint32_t*>(address(dispatch.indirect));
    return pass;
}

void CpuRecording::count_submission()
{
    engine_->stats->submissions += 1;
    engine_->stats->dispatches += passes_.size();
    engine_->stats->barriers += section_ends_.size() - 1;
}

void CpuRecording::replay()
{
    const std::lock_guard lock(engine_->mutex);
    const FlushDenormals flushed;
    count_submission();
    const Clock::time_point start = Clock::now();
    std::size_t begin = 0;
    for (const std::size_t end : section_ends_)
    {
        engine_->runner->run(std::span(passes_).subspan(begin, end - begin), sharing_.next());
        begin = end;
    }
    sharing_.took(nanoseconds_since(start));
}

std::vector<DispatchTime> CpuRecording::replay_timed()
{
    const std::lock_guard lock(engine_->mutex);
    const FlushDenormals flushed;
    count_submission();
    std::vector<DispatchTime> times;
    times.reserve(passes_.size());
    for (std::size_t i = 0; i < passes_.size(); ++i)
    {
        const Clock::time_point start = Clock::now();
        engine_->runner->run(std::span(passes_).subspan(i, 1), sharing_.best()); // nothing overlaps
        times.push_back({i, nanoseconds_since(start)});
    }
    return times;
}

} // namespace taut::cpu
