#pragma once
// The set-up of smoothed aggregation on the host: from a matrix to a chain of smaller ones.

#include "taut/linear/sparse.hpp"

#include <vector>

namespace taut::linear {

/// A level and the way to the next smaller one.
struct AggregationLevel
{
    SparseMatrix matrix;
    SparseMatrix prolongation; ///< matrix.rows x rows of the next level; empty on the last
    SparseMatrix restriction;  ///< its transpose
};

struct AggregationOptions
{
    double strength = 0.08;       ///< |a_ij| > strength sqrt(a_ii a_jj) couples; halved from level to level
    std::uint32_t coarsest = 256; ///< rows at which it stops
    int most_levels = 12;
};

struct AggregationHierarchy
{
    std::vector<AggregationLevel> levels; ///< the given matrix first
    /// Row-major pseudo-inverse of the last matrix: eigenvalues below 1e-12 of the largest count as zero.
    std::vector<double> coarsest_inverse;

    /// Entries of all levels over those of the first.
    double operator_complexity() const;
};

/// For symmetric matrices with a positive diagonal; rows that are zero throughout are left out of the
/// smaller matrices. Error{limit} at 2^31 - 1 rows or entries.
/// Vanek, Mandel, Brezina. Algebraic Multigrid by Smoothed Aggregation for Second and Fourth Order Elliptic
/// Problems. Computing 56, 1996: algorithm 5.1 (aggregates),
/// section 4 (the smoothed prolongation, here of constants). Stops early where aggregates no longer shrink
/// the system to two thirds; the last matrix may then be larger than `coarsest`, but Error{limit} beyond
/// 1,024 rows. Products and sums of matrices run on all cores; the answer has the same bits on any number.
AggregationHierarchy aggregate(const SparseMatrix&, const AggregationOptions& = {});

} // namespace taut::linear
