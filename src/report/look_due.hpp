#pragma once
// When a run is looked at for what passes through something.

#include <cstdint>

namespace taut {

/// Whether frame 1..frames is the last, or one of `looks` that are spread over the run.
constexpr bool look_due(std::uint64_t frame, std::uint64_t frames, std::uint64_t looks)
{
    return frame == frames || frame * looks / frames != (frame - 1) * looks / frames;
}

} // namespace taut
