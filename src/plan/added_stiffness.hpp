#pragma once
// Internal to src/plan: how stiff elements are that the program has added, for the stable step of methods
// that step explicitly.

#include "taut/scene/scene.hpp"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace taut {

/// Row sums of |K|, N/m, one a vertex of the body, as stiffness_rows() has them of springs and hinges: of the
/// second differences of each element's energy at x (m). Elements whose energy is not finite about x, or that
/// have no size there, count nothing.
std::vector<double> added_stiffness_rows(const Body& body, std::span<const glm::dvec3> x);

} // namespace taut
