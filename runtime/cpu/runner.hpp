#pragma once
// How the passes between two barriers are run: the difference between the three modes.

#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/cpu/pass.hpp"
#include "taut/runtime/cpu/sharing.hpp"

#include <memory>
#include <span>

namespace taut::cpu {

class Runner
{
public:
    virtual ~Runner() = default;

    /// Runs passes that have no barrier between them, and returns when all are done. `way` is what a
    /// runner with several threads may do; others have but one.
    virtual void run(std::span<Pass> passes, Way way) = 0;
};

std::unique_ptr<Runner> make_serial_runner();

/// `threads` counts the calling thread; 1 is the serial runner.
std::unique_ptr<Runner> make_parallel_runner(unsigned threads);

std::unique_ptr<Runner> make_shuffled_runner(std::uint64_t seed);

} // namespace taut::cpu
