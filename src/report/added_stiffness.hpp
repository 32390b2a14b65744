#pragma once
// Second derivatives of elements of which only the energy is known.

#include "taut/report/model.hpp"

#include <Eigen/Core>

#include <span>

namespace taut::reference {

/// N/m, three rows a corner of the element's kind, by central differences over 1e-4 of its size: to about
/// seven digits. Zero where all its corners are in one place.
Eigen::MatrixXd added_stiffness(const AddedElement& element, std::span<const glm::dvec3> x);

} // namespace taut::reference
