#pragma once
// The mean of places or velocities.

#include <glm/vec3.hpp>

#include <span>

namespace taut::test {

inline glm::dvec3 mean(std::span<const glm::dvec3> values)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

} // namespace taut::test
