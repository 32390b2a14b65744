#pragma once
// What meshes cannot carry of their materials: warnings of `taut check` and `taut run`.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// locking_issues() and fabric_mesh_issues(). `resolved`: by resolve(). Time: linear. Thread-safe.
std::vector<SceneIssue> mesh_issues(const Scene& resolved);

} // namespace taut
