#pragma once
// The box that places fill.

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <limits>

namespace taut {

/// Axis-aligned, m. Without places `low` is above `high`.
struct Extent
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void take(const glm::dvec3& place)
    {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    /// Its diagonal, m; 0 without places.
    double size() const { return low.x <= high.x ? glm::length(high - low) : 0; }
};

} // namespace taut
