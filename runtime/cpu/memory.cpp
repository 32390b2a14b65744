#include "taut/runtime/cpu/memory.hpp"

#include <cstdlib>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace taut::cpu {

namespace {

constexpr std::uint64_t kAlignment = 64;
constexpr std::uint64_t kHugePage = std::uint64_t{2} << 20;
constexpr std::uint64_t kLarge = 2 * kHugePage; ///< bytes from which a buffer asks for huge pages

/// Passes that stream through memory spend a third of their time on looking up small pages. Only a wish:
/// where the system has no huge pages, or gives none, nothing changes.
void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::uint64_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
}

} // namespace

CpuBuffer::CpuBuffer(std::uint64_t bytes, std::string_view label, std::shared_ptr<Stats> stats)
    : Buffer(bytes),
      stats_(std::move(stats))
{
    // calloc, because the system hands out large zero pages without writing them.
    const std::uint64_t alignment = bytes >= kLarge ? kHugePage : kAlignment;
    block_ = std::calloc(1, bytes + alignment);
    if (!block_)
        throw Error(ErrorCode::out_of_memory, "no memory for buffer \"" + std::string(label) + "\" of " +
                                                  std::to_string(bytes) + " bytes");
    const auto address = reinterpret_cast<std::uintptr_t>(block_);
    data_ = static_cast<std::byte*>(block_) + (alignment - address % alignment) % alignment;
    if (bytes >= kLarge)
        ask_for_huge_pages(data_, bytes);
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
