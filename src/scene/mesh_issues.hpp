#pragma once
// What meshes, and substeps that a scene names, cannot carry of its materials: warnings of `taut check` and
// `taut run`.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// locking_issues(), fabric_mesh_issues() and few_substeps_issues(). `resolved`: by resolve(). Time: linear.
/// Thread-safe.
std::vector<SceneIssue> mesh_issues(const Scene& resolved);

} // namespace taut
