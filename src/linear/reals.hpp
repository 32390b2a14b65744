#pragma once
// Doubles of the host as the reals of a device.

#include "taut/runtime/device.hpp"

#include <span>

namespace taut::linear {

/// Rounds to the precision and writes to the buffer from place `at` on (in reals).
void write_reals(Device&, const BufferPtr&, std::span<const double> values, Precision, std::uint64_t at = 0);
std::vector<double> read_reals(Device&, const BufferPtr&, std::size_t count, Precision, std::uint64_t at = 0);

/// Every value as two floats that add up to it (to 48 bits), high and low in turn.
std::vector<double> as_pairs(std::span<const double> values);

} // namespace taut::linear
