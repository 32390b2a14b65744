#pragma once
// Entry points of the native executor: kernels as C++ on the cores of this machine.
//
//   serial    the calling thread runs every element in order; the plain baseline
//   parallel  a pool of threads shares the dispatches between two barriers; results are bitwise those
//             of serial, because no element depends on the order that barriers leave open
//   shuffled  one thread, dispatches between barriers and elements of a dispatch in random order, a new
//             order every replay: a missing barrier or a wrong colour changes the result
//
// Runs what the build compiled: TAUT_KERNEL_DIR and kernels made at run time are for the other
// executors; compile() refuses a kernel without native code with Error{unsupported}.

#include "taut/runtime/device.hpp"

#include <cstdint>
#include <memory>

namespace taut {

enum class CpuMode : std::uint8_t
{
    serial,
    parallel,
    shuffled,
};

/// `threads` counts the calling thread; 0 = all hardware threads. Only parallel uses it.
DeviceInfo cpu_info(CpuMode mode, unsigned threads);

/// Throws Error{bad_input} for more than 1024 threads. replay() runs on the calling thread and is done
/// when it returns. Calls from several threads take turns.
std::shared_ptr<Device> open_cpu(CpuMode mode, const OpenOptions& options);

} // namespace taut
