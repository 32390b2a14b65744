#pragma once
// When `taut run` looks for what passes through something.

#include <cstdint>

namespace taut::cli {

/// Whether frame 1..frames is the last, or one of sixteen that are spread over the run.
constexpr bool look_due(std::uint64_t frame, std::uint64_t frames)
{
    constexpr std::uint64_t kLooks = 16;
    return frame == frames || frame * kLooks / frames != (frame - 1) * kLooks / frames;
}

} // namespace taut::cli
