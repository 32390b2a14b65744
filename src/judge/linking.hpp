#pragma once
// How often two closed curves are linked. A number that changes from one frame to the next shows that
// something went through something, even where no frame shows it. Based on: Gauss' integral, summed exactly
// over straight segments as in Klenin and Langowski 2000, "Computation of writhe in modeling of supercoiled
// DNA", eqs. 13-16.

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace taut::judging {

/// Of two closed polygons given by their corners in order; nothing where they touch, or come so near that the
/// sum is no whole number within 0.01.
std::optional<int> linking_number(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b);

} // namespace taut::judging
