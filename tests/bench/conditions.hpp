#pragma once
// The first line of every table: what must be known to compare two of them.

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Model name of the processor, as the native executor reports it.
std::string processor();

/// What a cache line takes to another core and back, ns: the least mean of nine turns. Depends on where the
/// system has put the threads. Two threads spin meanwhile.
double line_round_trip();

/// Version, devices, compiler, processor, round trip of a cache line and command. `program` stands for the
/// command's first word.
std::string conditions(const std::string& program, int argc, char** argv);

/// Vertices a side, 2 to 512, from the arguments `first` on; without any `otherwise`. Throws
/// std::runtime_error that names what is no such number.
std::vector<std::uint32_t> sides(int argc, char** argv, int first, std::vector<std::uint32_t> otherwise);

} // namespace bench
