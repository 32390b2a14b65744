#pragma once
// Membranes in the static reference: energy and forces to the digits of long double.

#include "taut/report/model.hpp"
#include "taut/report/static_state.hpp"

namespace taut::reference {

/// Whether the reference knows the element: Taut's own are written over any scalar, those of a program in
/// fp64 alone.
bool is_membrane(const AddedElement& element);

/// J, of one that is_membrane().
Real membrane_energy(const AddedElement& element, const State& x);
/// N, of one that is_membrane(): adds to its corners.
void add_membrane_gradient(const AddedElement& element, const State& x, State& g);

} // namespace taut::reference
