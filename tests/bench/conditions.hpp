#pragma once
// The first line of every table: what must be known to compare two of them.

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Model name of the processor, as the native executor reports it.
std::string processor();

/// Version, devices, compiler, processor and command. `program` stands for the command's first word.
std::string conditions(const std::string& program, int argc, char** argv);

/// Vertices a side, 2 to 512, from the arguments `first` on; without any `otherwise`. Throws
/// std::runtime_error that names what is no such number.
std::vector<std::uint32_t> sides(int argc, char** argv, int first, std::vector<std::uint32_t> otherwise);

} // namespace bench
