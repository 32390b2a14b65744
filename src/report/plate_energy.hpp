#pragma once
// Energy of plates by the angles of their hinges.

#include "taut/plan/plate_hinges.hpp"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace taut {

/// J a radian, of each hinge: A^-1 (theta - rest), A as plate_hinges.hpp says. A residual of 1e-10, or
/// what 5000 iterations leave.
std::vector<double> plate_moments(std::span<const PlateHinge> hinges, std::span<const glm::dvec3> x);

/// J: half of the moments times the turns.
double plate_energy(std::span<const PlateHinge> hinges, std::span<const glm::dvec3> x);

} // namespace taut
