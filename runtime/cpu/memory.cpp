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
constexpr std::uint64_t kLarge = kHugePage / 2; ///< bytes from which a buffer takes whole huge pages
constexpr std::uint64_t kPage = 4096;
constexpr std::uint64_t kStaggered = 4 * kPage; ///< bytes from which buffers begin anywhere in a page

/// Element i of two buffers that begin at the same place of a page falls on the same set of the cache, and
/// a sweep over constraints loses an eighth. Whole lines, and neighbours in the order of making are far
/// apart.
std::uint64_t place_in_page(std::uint64_t bytes, std::uint64_t number)
{
    return bytes < kStaggered ? 0 : number * (25 * kAlignment) % kPage;
}

constexpr std::uint64_t rounded_up(std::uint64_t n, std::uint64_t to) { return (n + to - 1) / to * to; }

/// Passes that stream through memory spend a third of their time on looking up small pages, and passes that
/// gather from buffers of 1 MiB a twentieth. Only a wish: where the system has no huge pages, or gives none,
/// nothing changes.
void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::uint64_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

} // namespace

CpuBuffer::CpuBuffer(std::uint64_t bytes, std::string_view label, std::shared_ptr<Stats> stats)
    : Buffer(bytes),
      stats_(std::move(stats))
{
    const std::uint64_t alignment = bytes >= kLarge ? kHugePage : kAlignment;
    const std::uint64_t place = place_in_page(bytes, stats_->made++);
    const std::uint64_t size = rounded_up(place + bytes, alignment);
    // calloc, because the system hands out large zero pages without writing them.
    block_ = std::calloc(1, alignment + size);
    if (!block_)
        throw Error(ErrorCode::out_of_memory, "no memory for buffer \"" + std::string(label) + "\" of " +
                                                  std::to_string(bytes) + " bytes");
    const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(block_);
    std::byte* const aligned = static_cast<std::byte*>(block_) + (rounded_up(address, alignment) - address);
    if (bytes >= kLarge)
        ask_for_huge_pages(aligned, size);
    data_ = aligned + place;
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
