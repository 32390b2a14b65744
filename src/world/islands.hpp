#pragma once
// Internal to src/world: bodies that are near enough to touch, by their boxes.

#include "taut/scene/extent.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace taut {

/// The box with `margin` [m] more on every side; one without places stays so.
Extent grown(Extent box, double margin);

/// Whether two boxes have a place in common; one without places has none.
bool overlap(const Extent& a, const Extent& b);

/// A number for each box, the same for those that hang together: by boxes that overlap and that may `meet`,
/// however many there are between. It is the least index among them. Sorts and sweeps: n log n for boxes that
/// are spread along x.
std::vector<std::uint32_t> islands(std::span<const Extent> boxes,
                                   const std::function<bool(std::uint32_t, std::uint32_t)>& meet);

} // namespace taut
