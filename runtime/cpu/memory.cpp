#include "taut/runtime/cpu/memory.hpp"

#include <cstdlib>
#include <utility>

namespace taut::cpu {

constexpr std::uint64_t kAlignment = 64;

CpuBuffer::CpuBuffer(std::uint64_t bytes, std::string_view label, std::shared_ptr<Stats> stats)
    : Buffer(bytes),
      stats_(std::move(stats))
{
    // calloc, because the system hands out large zero pages without writing them.
    block_ = std::calloc(1, bytes + kAlignment);
    if (!block_)
        throw Error(ErrorCode::out_of_memory, "no memory for buffer \"" + std::string(label) + "\" of " +
                                                  std::to_string(bytes) + " bytes");
    const auto address = reinterpret_cast<std::uintptr_t>(block_);
    data_ = static_cast<std::byte*>(block_) + (kAlignment - address % kAlignment) % kAlignment;
    stats_->bytes += bytes;
    stats_->blocks += 1;
}

CpuBuffer::~CpuBuffer()
{
    std::free(block_);
    stats_->bytes -= bytes();
    stats_->blocks -= 1;
}

} // namespace taut::cpu
