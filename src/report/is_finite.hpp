#pragma once
// Internal to src/report.

#include <glm/vec3.hpp>

#include <cmath>

namespace taut {

inline bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace taut
