#pragma once
// What a plan binds and dispatches: its buffers with the kernels that read and write them, its kernels in the
// order in which a step first runs them.

#include "taut/plan/plan.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace taut {

struct BoundBuffer
{
    std::string name, effect; ///< as PlanBuffer has them
    std::uint64_t bytes = 0;
    bool host_written = false; ///< new contents before every step
    /// full_name() of kernels in the order of the step; one that updates stands in both, one that only counts
    /// stands in the second.
    std::vector<std::string> read_by, written_by;
};

struct DispatchedKernel
{
    std::string name, effect;     ///< full_name(); the label of its dispatches
    std::uint64_t dispatches = 0; ///< of a step
    std::uint64_t elements =
        0; ///< of the step, summed over the dispatches; groups of a GROUP_KERNEL; at most
    bool of_groups = false;
};

/// Of every buffer of the plan, in its order. Pure.
std::vector<BoundBuffer> buffer_uses(const Plan& plan);

/// Of every pair of kernel and effect that a step dispatches. Pure.
std::vector<DispatchedKernel> kernel_uses(const Plan& plan);

} // namespace taut
