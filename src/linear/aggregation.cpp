// Based on: Vanek, Mandel, Brezina. Algebraic Multigrid by Smoothed Aggregation. Computing 56, 1996.
// Departures: constants are the only near null space (systems of displacements converge, though slower than
//   with rigid motions); the filtered matrix keeps its row sums by lumping weak entries to the diagonal.

#include "taut/linear/aggregation.hpp"

#include "taut/linear/host_sums.hpp"
#include "taut/linear/sparse_algebra.hpp"
#include "taut/runtime/base/error.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace taut::linear {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::uint32_t kMostCoarse = 1024;
constexpr double kLeastShrinking = 2.0 / 3.0;
constexpr std::uint64_t kMostIndices = 0x7fffffff; ///< rows or entries: device formats number no more
constexpr double kSmoothing = 4.0 / 3.0; ///< omega, over the largest eigenvalue of D^-1 A

void check_indices(std::uint64_t count, const char* what)
{
    if (count >= kMostIndices)
        throw Error(ErrorCode::limit, "aggregation numbers fewer than " + std::to_string(kMostIndices) + " " +
                                          what + ", but there are " + std::to_string(count) +
                                          ": take another preconditioner");
}

/// Entries that couple strongly, and the diagonal with the weak ones added.
SparseMatrix filtered(const SparseMatrix& a, double strength)
{
    const std::vector<double> own = diagonal(a);
    return build_rows(a.rows, a.columns, [&]() -> RowWriter {
        return [&](std::uint32_t row, auto& column, auto& value) {
            double lumped = 0;
            const std::size_t first = column.size();
            for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
            {
                const std::uint32_t other = a.column[k];
                const double bound = strength * std::sqrt(std::abs(own[row] * own[other]));
                if (other == row || !(std::abs(a.value[k]) > bound))
                {
                    lumped += a.value[k];
                    continue;
                }
                column.push_back(other);
                value.push_back(a.value[k]);
            }
            const auto at =
                std::lower_bound(column.begin() + static_cast<std::ptrdiff_t>(first), column.end(), row) -
                column.begin();
            column.insert(column.begin() + at, row);
            // Lumping can eat up a diagonal; then the row stays as weak as it is.
            value.insert(value.begin() + at, lumped > 0.1 * own[row] ? lumped : own[row]);
        };
    });
}

/// 1 / diagonal. A zero row has 1: it couples to nothing, so any number serves.
std::vector<double> inverse_divisor(const SparseMatrix& a)
{
    std::vector<double> out = diagonal(a);
    for (double& value : out)
        value = value == 0 ? 1 : 1 / value;
    return out;
}

/// Number of the aggregate of every row; rows without strong neighbours make aggregates of their own. Zero
/// rows are in none: no coarser matrix has anything to say of them.
class Aggregates
{
public:
    explicit Aggregates(const SparseMatrix& strong) : strong_(strong), of_(strong.rows, kNone)
    {
        const std::vector<double> own = diagonal(strong_);
        for (std::uint32_t row = 0; row < strong_.rows; ++row)
            if (own[row] != 0)
                seed(row);
        const std::vector<std::uint32_t> seeded = of_;
        for (std::uint32_t row = 0; row < strong_.rows; ++row)
            if (of_[row] == kNone)
                join(row, seeded);
        for (std::uint32_t row = 0; row < strong_.rows; ++row)
            if (of_[row] == kNone && own[row] != 0)
                gather(row);
    }

    std::uint32_t count() const { return count_; }
    /// kNone for a zero row.
    std::uint32_t of(std::uint32_t row) const { return of_[row]; }

private:
    /// Itself, too: filtered() gives every row a diagonal.
    std::span<const std::uint32_t> neighbours(std::uint32_t row) const
    {
        return std::span(strong_.column).subspan(strong_.row_start[row], strong_.row_length(row));
    }

    /// A row whose whole neighbourhood is free.
    void seed(std::uint32_t row)
    {
        for (const std::uint32_t other : neighbours(row))
            if (of_[other] != kNone)
                return;
        gather(row);
    }

    void gather(std::uint32_t row)
    {
        for (const std::uint32_t other : neighbours(row))
            if (of_[other] == kNone)
                of_[other] = count_;
        ++count_;
    }

    /// The aggregate that the row is coupled to most.
    void join(std::uint32_t row, const std::vector<std::uint32_t>& seeded)
    {
        double most = 0;
        for (std::uint32_t k = strong_.row_start[row]; k < strong_.row_start[row + 1]; ++k)
        {
            const std::uint32_t aggregate = seeded[strong_.column[k]];
            const double coupling = std::abs(strong_.value[k]);
            if (aggregate == kNone || strong_.column[k] == row || coupling <= most)
                continue;
            most = coupling;
            of_[row] = aggregate;
        }
    }

    const SparseMatrix& strong_;
    std::vector<std::uint32_t> of_;
    std::uint32_t count_ = 0;
};

/// Columns of unit length: then coarse matrices keep the size of the fine one's entries.
SparseMatrix tentative(const Aggregates& aggregates, std::uint32_t rows)
{
    std::vector<double> size(aggregates.count(), 0);
    for (std::uint32_t row = 0; row < rows; ++row)
        if (aggregates.of(row) != kNone)
            size[aggregates.of(row)] += 1;
    return build_rows(rows, aggregates.count(), [&]() -> RowWriter {
        return [&](std::uint32_t row, auto& column, auto& value) {
            if (aggregates.of(row) == kNone)
                return;
            column.push_back(aggregates.of(row));
            value.push_back(1 / std::sqrt(size[aggregates.of(row)]));
        };
    });
}

void scale_rows(SparseMatrix& a, std::span<const double> by)
{
    for (std::uint32_t row = 0; row < a.rows; ++row)
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
            a.value[k] *= by[row];
}

SparseMatrix smoothed(const SparseMatrix& tentative, const SparseMatrix& strong)
{
    std::vector<double> scale = inverse_divisor(strong);
    const double highest = gershgorin<std::uint32_t>(strong.row_start, strong.column, strong.value, scale);
    for (double& value : scale)
        value *= -kSmoothing / highest;
    SparseMatrix image = product(strong, tentative);
    scale_rows(image, scale);
    return sum(tentative, image);
}

/// (A + A^T) / 2: exactly symmetric, which rounding of a product is not.
SparseMatrix symmetric_part(const SparseMatrix& a)
{
    SparseMatrix out = sum(a, transpose(a));
    for (double& value : out.value)
        value *= 0.5;
    return out;
}

Eigen::MatrixXd to_dense(const SparseMatrix& a)
{
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.rows, a.columns);
    for (std::uint32_t row = 0; row < a.rows; ++row)
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
            out(row, a.column[k]) = a.value[k];
    return out;
}

std::vector<double> pseudo_inverse(const SparseMatrix& a)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{to_dense(a)};
    Eigen::VectorXd inverse = solver.eigenvalues();
    const double least = 1e-12 * inverse.cwiseAbs().maxCoeff();
    for (double& value : inverse)
        value = value > least ? 1 / value : 0;
    const Eigen::MatrixXd dense =
        solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
    std::vector<double> out;
    for (int row = 0; row < dense.rows(); ++row)
        for (int column = 0; column < dense.cols(); ++column)
            out.push_back(0.5 * (dense(row, column) + dense(column, row)));
    return out;
}

} // namespace

double AggregationHierarchy::operator_complexity() const
{
    double entries = 0;
    for (const AggregationLevel& level : levels)
        entries += static_cast<double>(level.matrix.nonzeros());
    return entries / std::max(1.0, static_cast<double>(levels.front().matrix.nonzeros()));
}

AggregationHierarchy aggregate(const SparseMatrix& matrix, const AggregationOptions& options)
{
    check_indices(matrix.rows, "rows");
    check_indices(matrix.nonzeros(), "entries");
    AggregationHierarchy out;
    SparseMatrix a = matrix;
    double strength = options.strength;
    for (int level = 1; level < options.most_levels && a.rows > options.coarsest; ++level)
    {
        const SparseMatrix strong = filtered(a, strength);
        const Aggregates aggregates(strong);
        if (aggregates.count() == 0 || aggregates.count() > kLeastShrinking * static_cast<double>(a.rows))
            break;
        SparseMatrix prolongation = smoothed(tentative(aggregates, a.rows), strong);
        SparseMatrix restriction = transpose(prolongation);
        SparseMatrix coarse = symmetric_part(product(restriction, product(a, prolongation)));
        out.levels.push_back({std::move(a), std::move(prolongation), std::move(restriction)});
        a = std::move(coarse);
        strength /= 2;
    }
    if (a.rows > kMostCoarse)
        throw Error(ErrorCode::limit, "aggregation stops at " + std::to_string(a.rows) +
                                          " rows, and a direct solve "
                                          "of more than " +
                                          std::to_string(kMostCoarse) +
                                          " is too much: take another preconditioner");
    out.coarsest_inverse = pseudo_inverse(a);
    out.levels.push_back({std::move(a), {}, {}});
    return out;
}

} // namespace taut::linear
