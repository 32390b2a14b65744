#pragma once
// The signed distance to a box about the origin.

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace taut::test {

/// m; `half`: half of its edges, m. Exact outside, and inside by the nearest face.
inline double box_distance(const glm::dvec3& p, const glm::dvec3& half)
{
    const glm::dvec3 over = glm::abs(p) - half;
    return glm::length(glm::max(over, glm::dvec3(0))) + std::min(std::max({over.x, over.y, over.z}), 0.0);
}

} // namespace taut::test
