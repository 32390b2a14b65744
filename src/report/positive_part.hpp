#pragma once
// The part of a symmetric matrix that is positive semidefinite: eigenvalues below zero are set to zero.
//
// Based on: Teran, Sifakis, Irving, Fedkiw. Robust Quasistatic Finite Elements and Flesh Simulation. SCA
//   2005.
// Departures: none.

#include <Eigen/Eigenvalues>

namespace taut::reference {

/// Of (k + k^T) / 2. Any size; values of any unit.
template <typename Matrix>
Matrix positive_part(const Matrix& k)
{
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(0.5 * (k + k.transpose()));
    const auto kept = solver.eigenvalues().cwiseMax(0).eval();
    return solver.eigenvectors() * kept.asDiagonal() * solver.eigenvectors().transpose();
}

} // namespace taut::reference
