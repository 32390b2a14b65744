#pragma once
// A compiled list of the native executor: passes, cut at the barriers.

#include "taut/runtime/cpu/memory.hpp"
#include "taut/runtime/cpu/runner.hpp"
#include "taut/runtime/cpu/sharing.hpp"

#include <mutex>
#include <vector>

namespace taut::cpu {

/// What a device and its recordings share. Recordings may outlive the device.
struct Engine
{
    std::shared_ptr<Stats> stats = std::make_shared<Stats>();
    std::mutex mutex; ///< one replay, read or write at a time
    std::unique_ptr<Runner> runner;
};

class CpuRecording final : public Recording
{
public:
    /// `desc` has passed check_limits. Throws Error{unsupported} for a kernel without native code and
    /// Error{bad_input} for a buffer of another device.
    CpuRecording(RecordingDesc desc, std::shared_ptr<Engine> engine);

    void replay() override;
    std::vector<DispatchTime> replay_timed() override;

private:
    Pass make_pass(const Dispatch& dispatch) const;
    std::byte* address(const BufferRange& range) const;
    void count_submission();

    std::shared_ptr<Engine> engine_;
    std::vector<BufferPtr> buffers_;
    std::vector<Pass> passes_;
    std::vector<std::size_t> section_ends_; ///< in passes_: a barrier or the end of the list
    Sharing sharing_;
};

} // namespace taut::cpu
