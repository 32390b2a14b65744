#pragma once
// Internal to src/world: what a plan asks for, on a device.

#include "taut/plan/plan.hpp"
#include "taut/runtime/device.hpp"
#include "taut/world/inputs.hpp"

#include <vector>

namespace taut {

/// The buffers of a plan with their first contents; inputs come with the submission.
std::vector<BufferPtr> make_buffers(Device& device, const Plan& plan);

/// Views of `inputs` for the device.
std::vector<BufferWrite> writes_of(const std::vector<BufferPtr>& buffers,
                                   const std::vector<InputWrite>& inputs);

} // namespace taut
