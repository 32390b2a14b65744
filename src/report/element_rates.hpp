#pragma once
// How stiff tetrahedra and enclosed volumes are, as sums that bound how fast their vertices can swing.

#include "taut/plan/solid.hpp"
#include "taut/plan/surface.hpp"

#include <span>

namespace taut::reference {

/// Adds to `rows` (N/m, one a vertex), for each vertex of the element, the sum over all its vertices of
/// bounds on the spectral norm of the 3 x 3 blocks of the element's Hessian at `x` (m). No eigenvalue of
/// M^-1 K is larger than the largest of rows / mass. Infinite for rigid elements.
void add_stiffness(const SolidElement& element, std::span<const glm::dvec3> x, std::span<double> rows);
void add_stiffness(const VolumeElement& element, std::span<const glm::dvec3> x, std::span<double> rows);
void add_stiffness(const SurfaceElement& element, std::span<const glm::dvec3> x, std::span<double> rows);

} // namespace taut::reference
