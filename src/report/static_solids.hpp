#pragma once
// Tetrahedra in the static reference: energy, forces and stiffness.

#include "taut/report/model.hpp"
#include "taut/report/static_state.hpp"

#include <Eigen/Core>

#include <vector>

namespace taut::reference {

/// Elastic tetrahedra, and volumes that are held beside springs as such without shear stiffness.
std::vector<SolidElement> all_solids(const PhysicalModel& model);

Real solid_energy(const SolidElement& e, const State& x);                 ///< J
void add_solid_gradient(const SolidElement& e, const State& x, State& g); ///< N, to its corners
/// N/m, of its four corners.
Eigen::Matrix<double, 12, 12> solid_block(const SolidElement& e, const State& x, Curvature curvature);

} // namespace taut::reference
