#pragma once
// Whether a mesh, and numbers of the precision that a scene takes, can carry a fabric: warnings of `taut
// check` and `run`.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// A warning for each fabric whose mean edge is longer than a third of its bending length c = (B / (density
/// g))^(1/3), B the smaller rigidity of warp and weft, and for each whose strain by its own weight, density g
/// L / modulus, is below half a digit of the scene's precision, L its size. Without gravity, or without a
/// rigidity, there is nothing to compare with. `resolved`: by resolve(). Time: linear.
///
/// Based on: Peirce. The "Handle" of Cloth as a Measurable Quantity. Journal of the Textile Institute 21,
/// 1930 (c).
std::vector<SceneIssue> fabric_mesh_issues(const Scene& resolved);

inline constexpr double kEdgesInBend =
    3; // in a bending length: coarser, folds are held open by membranes that cannot shear

} // namespace taut
