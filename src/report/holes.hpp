#pragma once
// Which colliders fit between the vertices of which bodies, that alone meet them: warnings of `taut check`.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// A warning for each collider that goes through the largest triangle of a body at rest: its cross-section
/// at its slimmest (of a distance field round its deep points) lies within the smallest circle round that.
/// Planes do not. `resolved`: by resolve(). Time: linear in the triangles.
std::vector<SceneIssue> holes_issues(const Scene& resolved);

} // namespace taut
