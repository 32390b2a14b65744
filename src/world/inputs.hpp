#pragma once
// Internal to src/world: what the host writes to the device before each step.

#include "taut/plan/plan.hpp"
#include "taut/scene/scene.hpp"
#include "taut/world/program_motion.hpp"

#include <cstddef>
#include <vector>

namespace taut {

/// One write: a buffer of the plan and its new contents from `offset` [bytes] on.
struct InputWrite
{
    std::uint32_t buffer = kNoBuffer;
    std::vector<std::byte> bytes;
    std::uint64_t offset = 0;
};

/// What a snapshot has of a buffer that it has.
std::vector<std::uint32_t> words_of(const std::vector<InputWrite>& snapshot, std::uint32_t buffer);

/// The time of a step, s.
struct Stretch
{
    double from = 0, to = 0;
};

/// True if a scene changes anything but the first step's values from step to step by itself.
bool inputs_move(const Scene& scene, const Plan& plan);

/// Step values, colliders, wind and pin targets of a step; colliders and wind that the program moves have
/// their keys in the scene.
std::vector<InputWrite> step_inputs(const Scene& scene, const Plan& plan, const Stretch& step,
                                    const ProgramMotion& program = {});

} // namespace taut
