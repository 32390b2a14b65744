#pragma once
// Matrices with known eigenvalues, and condition numbers of others.
//
// Based on:
//   Golub, Van Loan. Matrix Computations. 4th edition, 8.4 (bisection), 10.1 (Lanczos), 11.3 (the
//   tridiagonal matrix that conjugate gradients make).
// Departures: none.

#include "support/random.hpp"
#include "taut/linear/sparse.hpp"

#include <Eigen/Jacobi>

#include <algorithm>
#include <cmath>
#include <vector>

namespace taut::test {

/// A random symmetric matrix of `rows` rows with the eigenvalues condition^(-i / (rows - 1)), 0 <= i < rows,
/// to rounding: their diagonal matrix under three rounds of rotations in random planes.
inline linear::SparseMatrix prescribed_matrix(std::uint32_t rows, double condition)
{
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, rows);
    for (std::uint32_t i = 0; i < rows; ++i)
        a(i, i) = std::pow(condition, -double(i) / (rows - 1));
    conformance::Random random(3);
    for (int round = 0; round < 3; ++round)
    {
        const std::vector<std::uint32_t> order = random.shuffled(rows);
        for (std::uint32_t k = 0; k + 1 < rows; k += 2)
        {
            const double angle = random.uniform(0, 6.283185307179586);
            const Eigen::JacobiRotation<double> turn(std::cos(angle), std::sin(angle));
            a.applyOnTheLeft(order[k], order[k + 1], turn.adjoint());
            a.applyOnTheRight(order[k], order[k + 1], turn);
        }
    }
    a = Eigen::MatrixXd(a.selfadjointView<Eigen::Upper>()); // rounding leaves the halves apart
    return linear::from_dense(rows, rows, {a.data(), std::size_t{rows} * rows});
}

/// Of a symmetric tridiagonal matrix: how many of its eigenvalues are below x (Sturm's sequence).
inline std::size_t eigenvalues_below(const std::vector<double>& diagonal, const std::vector<double>& beside,
                                     double x)
{
    std::size_t count = 0;
    double pivot = 1;
    for (std::size_t i = 0; i < diagonal.size(); ++i)
    {
        pivot = diagonal[i] - x - (i > 0 ? beside[i - 1] * beside[i - 1] / pivot : 0);
        if (pivot == 0)
            pivot = 1e-300; // as if x were smaller by less than rounding
        count += pivot < 0;
    }
    return count;
}

/// Its eigenvalue number `rank` from below, from 0; all are positive and at most `most`. To 12 digits.
inline double eigenvalue(const std::vector<double>& diagonal, const std::vector<double>& beside,
                         std::size_t rank, double most)
{
    double low = most * 1e-20, high = most;
    while (high / low > 1 + 1e-12)
    {
        const double middle = std::sqrt(low * high);
        (eigenvalues_below(diagonal, beside, middle) > rank ? high : low) = middle;
    }
    return high;
}

/// Largest over smallest eigenvalue of S A S, with S = 1 or, where `scaled`, S = 1 / sqrt(diagonal of A), as
/// Jacobi has it. A is symmetric positive definite. The extreme eigenvalues of the tridiagonal matrix that
/// conjugate gradients make, run in fp64 to a residual of 1e-14 or for so many iterations: a lower bound,
/// which is close once they have converged.
inline double condition_number(const linear::SparseMatrix& a, bool scaled, int iterations = 10000)
{
    using Vector = Eigen::VectorXd;
    Vector scale = Vector::Ones(a.rows);
    for (std::uint32_t i = 0; scaled && i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            if (a.column[k] == i)
                scale[i] = 1 / std::sqrt(a.value[k]);
    conformance::Random random(2);
    Vector r(a.rows), q(a.rows);
    for (double& entry : r)
        entry = random.uniform(-1, 1);
    Vector p = r;
    std::vector<double> diagonal, beside;
    double rr = r.squaredNorm(), carried = 0; // beta / alpha of the iteration before
    const double end = 1e-28 * rr;
    for (int k = 0; k < iterations && rr > end; ++k)
    {
        const Vector z = scale.cwiseProduct(p);
        linear::multiply(a, {z.data(), a.rows}, {q.data(), a.rows});
        q = scale.cwiseProduct(q);
        const double alpha = rr / p.dot(q);
        r -= alpha * q;
        const double beta = r.squaredNorm() / rr;
        diagonal.push_back(1 / alpha + carried);
        beside.push_back(std::sqrt(beta) / alpha);
        carried = beta / alpha;
        p = r + beta * p;
        rr *= beta;
    }
    double most = 0; // Gershgorin
    for (std::size_t i = 0; i < diagonal.size(); ++i)
        most = std::max(most, diagonal[i] + beside[i] + (i > 0 ? beside[i - 1] : 0));
    return eigenvalue(diagonal, beside, diagonal.size() - 1, most) / eigenvalue(diagonal, beside, 0, most);
}

} // namespace taut::test
