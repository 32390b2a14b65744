#pragma once
// The effects of a scene by name, for those who leave some out (PlanOptions::available_effects).

#include "taut/scene/scene.hpp"

#include <string>
#include <vector>

namespace taut {

/// Names of the rows of the table of effects that a resolved scene calls for under its method, in the order
/// of a step, each once.
std::vector<std::string> effect_names(const Scene& resolved);

} // namespace taut
