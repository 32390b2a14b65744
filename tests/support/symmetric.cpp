#include "support/symmetric.hpp"

#include <Eigen/Eigenvalues>

namespace taut {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Spectrum symmetric_spectrum(const Eigen::MatrixXd& matrix)
{
    const Solver solver(matrix);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix)
{
    return Solver(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

} // namespace taut
