#pragma once
// Plates in the static reference: energy and forces by the moments at their hinges, and the rows that make
// moments unknowns.

#include "taut/plan/plate_hinges.hpp"
#include "taut/report/static_state.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <span>
#include <vector>

namespace taut::reference {

/// Of the plates of one model, which must outlive it. Safe from several threads.
class StaticPlates
{
public:
    explicit StaticPlates(std::span<const PlateHinge> hinges);

    std::size_t count() const { return hinges_.size(); }
    /// False where rounding leaves A no factorisation, as slivers do: then nothing else may be asked.
    bool is_sound() const { return hinges_.empty() || factor_.info() == Eigen::Success; }
    Real energy(const State& x) const;                 ///< J
    void add_gradient(const State& x, State& g) const; ///< N, pinned vertices too
    /// J a radian, A^-1 (theta - rest) of every hinge, A as PlateHinge says; to long double's digits.
    std::vector<Real> moments(const State& x) const;
    /// The lower triangle of [0, J^T; J, -A], J = dtheta/dx, A scaled to a unit diagonal: rows from `first`
    /// on belong to hinges, columns before it to coordinates, `unknown` the first of each vertex, -1 =
    /// pinned.
    void add_rows(const State& x, int first, std::span<const int> unknown,
                  std::vector<Eigen::Triplet<double>>& entries) const;

private:
    std::vector<Real> turns(const State& x) const;
    double unit(std::size_t hinge) const; ///< J^-1/2 radian: the root of its softness

    std::span<const PlateHinge> hinges_;
    Eigen::SparseMatrix<double> scaled_; ///< A over the units of row and column
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

} // namespace taut::reference
