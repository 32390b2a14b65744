#pragma once
// Substeps that a scene names and that are too few for its solids: a warning of `taut check` and `run`.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// A warning where solids are held or can meet something and would take more than kFewSubsteps times as many
/// (docs/methods.md, "Substeps that nobody named"). Of xpbd and implicit_euler: pbd has a stiffness of its
/// own, vbd meets colliders in its sweeps, and the others do not sweep. `resolved`: by resolve().
std::vector<SceneIssue> few_substeps_issues(const Scene& resolved);

inline constexpr double kFewSubsteps = 4; ///< measured, see the page

} // namespace taut
