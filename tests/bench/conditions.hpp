#pragma once
// The first line of every table: what must be known to compare two of them.

#include <string>

namespace bench {

/// Model name of the processor, as the native executor reports it.
std::string processor();

/// Version, devices, compiler, processor and command. `program` stands for the command's first word.
std::string conditions(const std::string& program, int argc, char** argv);

} // namespace bench
