#pragma once
// The part of a symmetric matrix that is positive semidefinite: eigenvalues below zero are set to zero.

#include <Eigen/Core>

namespace taut::reference {

/// Of (k + k^T) / 2; square, values of any unit. Threads may call it at once.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& k);

} // namespace taut::reference
