#pragma once
// Doubles of the host as the reals of a device.

#include "taut/runtime/device.hpp"

#include <span>

namespace taut::linear {

/// Rounds to the precision and writes to the start of the buffer.
void write_reals(Device&, const BufferPtr&, std::span<const double> values, Precision);
std::vector<double> read_reals(Device&, const BufferPtr&, std::size_t count, Precision);

/// Every value as two floats that add up to it (to 48 bits), high and low in turn.
std::vector<double> as_pairs(std::span<const double> values);

} // namespace taut::linear
