#pragma once
// Class R4 of the references: a method refined until it agrees with itself.

#include "taut/report/cost_reference.hpp"

#include <string>
#include <vector>

namespace taut::cost {

/// Frames of a first try, and the fewest that make a study.
inline constexpr std::size_t kFirstWindow = 15, kFewest = 6;

/// Where a fine run of the method in double comes to rest.
Motion settled_run(const Question& question, MethodKind method, std::uint32_t substeps);

/// R4, or none; `passed` says why stronger classes were not taken.
CostReference self_at_rest(const Question& question, std::vector<std::string> passed);
CostReference self_motion(const Question& question, std::size_t frames, std::vector<std::string> passed);

/// Two digits.
std::string number(double value);
/// "19 frames (0.32 s)"
std::string frames_text(std::size_t frames, double timestep);

} // namespace taut::cost
