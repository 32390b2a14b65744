#pragma once
// Eigenvalues of small symmetric matrices, compiled once: of each user the solver would take 8 to 10 s.

#include <Eigen/Core>

namespace taut {

struct Spectrum
{
    Eigen::VectorXd values;  ///< ascending
    Eigen::MatrixXd vectors; ///< a column each, of length 1
};

/// Of a symmetric matrix, of which the lower triangle is read.
Spectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

} // namespace taut
