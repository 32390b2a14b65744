// Based on: Teran, Sifakis, Irving, Fedkiw. Robust Quasistatic Finite Elements and Flesh Simulation. SCA
//   2005.
// Departures: none.
#include "taut/report/positive_part.hpp"

#include <Eigen/Eigenvalues>

namespace taut::reference {

// Here and not in the header, because the solver takes its users ten seconds each to compile.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& k)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (k + k.transpose()));
    const Eigen::VectorXd kept = solver.eigenvalues().cwiseMax(0);
    return solver.eigenvectors() * kept.asDiagonal() * solver.eigenvectors().transpose();
}

} // namespace taut::reference
