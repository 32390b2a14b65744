#pragma once
// Membranes in the static reference: energy and forces to the digits of long double.

#include "taut/report/model.hpp"
#include "taut/report/static_state.hpp"

#include <Eigen/Core>

namespace taut::reference {

/// Whether the reference knows the element: Taut's own are written over any scalar, those of a program in
/// fp64 alone.
bool is_membrane(const AddedElement& element);

/// J, of one that is_membrane().
Real membrane_energy(const AddedElement& element, const State& x);
/// N/m, of one that is_membrane(): of its three corners, to ten digits. Stiff cloth that bends softly needs
/// them: the six of added_stiffness.hpp would hide whether a fold is stable.
Eigen::Matrix<double, 9, 9> membrane_stiffness(const AddedElement& element, const State& x);
/// N, of one that is_membrane(): adds to its corners.
void add_membrane_gradient(const AddedElement& element, const State& x, State& g);

} // namespace taut::reference
