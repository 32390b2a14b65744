#pragma once
// Internal to src/world: what the host writes to the device before each step.

#include "taut/plan/plan.hpp"
#include "taut/scene/scene.hpp"

#include <cstddef>
#include <vector>

namespace taut {

/// One write: a buffer of the plan and its new contents.
struct InputWrite
{
    std::uint32_t buffer = kNoBuffer;
    std::vector<std::byte> bytes;
};

/// True if anything but the first step's values changes from step to step.
bool inputs_move(const Scene& scene, const Plan& plan);

/// Step values, colliders and pin targets for the step from `time` to `time + timestep`.
std::vector<InputWrite> step_inputs(const Scene& scene, const Plan& plan, double time);

} // namespace taut
