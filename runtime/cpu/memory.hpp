#pragma once
// Buffers of the native executor, and the counters that outlive the device that they belong to.

#include "taut/runtime/device.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace taut::cpu {

/// Shared by a device, its buffers and its recordings; also tells buffers of two devices apart.
struct Stats
{
    std::atomic<std::uint64_t> submissions{0};
    std::atomic<std::uint64_t> dispatches{0};
    std::atomic<std::uint64_t> barriers{0};
    std::atomic<std::uint64_t> bytes{0};
    std::atomic<std::uint64_t> blocks{0};
    std::atomic<std::uint64_t> made{0}; ///< buffers ever
};

class CpuBuffer final : public Buffer
{
public:
    /// Zero-filled and aligned to 64 bytes. Throws Error{out_of_memory} naming `label`.
    CpuBuffer(std::uint64_t bytes, std::string_view label, std::shared_ptr<Stats> stats);
    ~CpuBuffer() override;
    CpuBuffer(const CpuBuffer&) = delete;
    CpuBuffer& operator=(const CpuBuffer&) = delete;

    std::byte* data() const { return data_; }
    const Stats* owner() const { return stats_.get(); }

private:
    std::shared_ptr<Stats> stats_;
    void* block_ = nullptr;
    std::byte* data_ = nullptr;
};

} // namespace taut::cpu
