#pragma once
// Which solids have too few tetrahedra across to bend as their material does: warnings of `taut check` and
// `run`.

#include "taut/scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace taut {

/// How many tetrahedra lie between the surface and the surface on the other side, where the body is thickest:
/// twice the edges from the surface to the vertex that is the furthest in, and one more where a tetrahedron
/// has four such vertices. 0 of what has no tetrahedra, or no surface. Time: linear.
std::uint32_t tetrahedra_across(const Mesh& mesh);

/// A warning for each body of linear tetrahedra that is fewer across than kAcrossToBend, or than
/// kAcrossIncompressible where Poisson's ratio is above kIncompressible; and for springs of solids. Measured
/// in docs/solids.md, "How stiff tetrahedra are". `resolved`: by resolve().
std::vector<SceneIssue> locking_issues(const Scene& resolved);

inline constexpr std::uint32_t kAcrossToBend = 4, kAcrossIncompressible = 8;
inline constexpr double kIncompressible = 0.4;

} // namespace taut
