#pragma once
// Internal to src/report: directions that pictures and their cameras share.

#include <glm/vec3.hpp>

namespace taut {

/// A unit vector across `axis`: world z for an upright y.
glm::dvec3 across(const glm::dvec3& axis);

} // namespace taut
