// Based on: Vanek, Mandel, Brezina. Algebraic Multigrid by Smoothed Aggregation. Computing 56, 1996.
// Departures: constants are the only near null space (systems of displacements converge, though slower than
//   with rigid motions); the filtered matrix keeps its row sums by lumping weak entries to the diagonal.

#include "taut/linear/aggregation.hpp"

#include "taut/linear/host_sums.hpp"
#include "taut/runtime/base/error.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut::linear {
namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr std::uint32_t kMostCoarse = 1024;
constexpr double kLeastShrinking = 2.0 / 3.0;
constexpr std::uint64_t kMostIndices = 0x7fffffff; ///< rows or entries that Eigen numbers with int
constexpr double kSmoothing = 4.0 / 3.0; ///< omega, over the largest eigenvalue of D^-1 A

void check_indices(std::uint64_t count, const char* what)
{
    if (count >= kMostIndices)
        throw Error(ErrorCode::limit, "aggregation numbers fewer than " + std::to_string(kMostIndices) + " " +
                                          what + ", but there are " + std::to_string(count) +
                                          ": take another preconditioner");
}

Rows to_eigen(const SparseMatrix& a)
{
    check_indices(a.rows, "rows");
    check_indices(a.nonzeros(), "entries");
    Rows out(a.rows, a.columns);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(a.nonzeros());
    for (const Triplet& t : to_triplets(a))
        entries.emplace_back(static_cast<int>(t.row), static_cast<int>(t.column), t.value);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

SparseMatrix from_eigen(const Rows& a)
{
    std::vector<Triplet> entries;
    entries.reserve(static_cast<std::size_t>(a.nonZeros()));
    for (int row = 0; row < a.outerSize(); ++row)
        for (Rows::InnerIterator it(a, row); it; ++it)
            entries.push_back(
                {static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(it.col()), it.value()});
    return from_triplets(static_cast<std::uint32_t>(a.rows()), static_cast<std::uint32_t>(a.cols()), entries);
}

/// Entries that couple strongly, and the diagonal with the weak ones added.
Rows filtered(const Rows& a, double strength)
{
    const Eigen::VectorXd diagonal = a.diagonal();
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < a.outerSize(); ++row)
    {
        double own = 0;
        for (Rows::InnerIterator it(a, row); it; ++it)
        {
            const double bound = strength * std::sqrt(std::abs(diagonal[row] * diagonal[it.col()]));
            if (it.col() != row && std::abs(it.value()) > bound)
                entries.emplace_back(row, static_cast<int>(it.col()), it.value());
            else
                own += it.value();
        }
        // Lumping can eat up a diagonal; then the row stays as weak as it is.
        entries.emplace_back(row, row, own > 0.1 * diagonal[row] ? own : diagonal[row]);
    }
    Rows out(a.rows(), a.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

/// The diagonal by which rows are divided. A zero row has 1: it couples to nothing, so any number serves.
Eigen::VectorXd divisor(const Rows& a)
{
    Eigen::VectorXd diagonal = a.diagonal();
    for (double& value : diagonal)
        value = value == 0 ? 1 : value;
    return diagonal;
}

/// Number of the aggregate of every row; rows without strong neighbours make aggregates of their own. Zero
/// rows are in none: no coarser matrix has anything to say of them.
class Aggregates
{
public:
    explicit Aggregates(const Rows& strong)
        : strong_(strong),
          of_(static_cast<std::size_t>(strong.rows()), kNone)
    {
        const Eigen::VectorXd diagonal = strong_.diagonal();
        for (int row = 0; row < strong_.rows(); ++row)
            if (diagonal[row] != 0)
                seed(row);
        const std::vector<std::uint32_t> seeded = of_;
        for (int row = 0; row < strong_.rows(); ++row)
            if (at(row) == kNone)
                join(row, seeded);
        for (int row = 0; row < strong_.rows(); ++row)
            if (at(row) == kNone && diagonal[row] != 0)
                gather(row);
    }

    std::uint32_t count() const { return count_; }
    /// kNone for a zero row.
    std::uint32_t of(int row) const { return of_[static_cast<std::size_t>(row)]; }

private:
    std::uint32_t& at(int row) { return of_[static_cast<std::size_t>(row)]; }

    /// A row whose whole neighbourhood is free.
    void seed(int row)
    {
        for (Rows::InnerIterator it(strong_, row); it; ++it)
            if (at(static_cast<int>(it.col())) != kNone)
                return;
        gather(row);
    }

    void gather(int row)
    {
        for (Rows::InnerIterator it(strong_, row); it; ++it)
            if (at(static_cast<int>(it.col())) == kNone)
                at(static_cast<int>(it.col())) = count_;
        ++count_;
    }

    /// The aggregate that the row is coupled to most.
    void join(int row, const std::vector<std::uint32_t>& seeded)
    {
        double most = 0;
        for (Rows::InnerIterator it(strong_, row); it; ++it)
        {
            const std::uint32_t aggregate = seeded[static_cast<std::size_t>(it.col())];
            if (aggregate == kNone || it.col() == row || std::abs(it.value()) <= most)
                continue;
            most = std::abs(it.value());
            at(row) = aggregate;
        }
    }

    const Rows& strong_;
    std::vector<std::uint32_t> of_;
    std::uint32_t count_ = 0;
};

/// Columns of unit length: then coarse matrices keep the size of the fine one's entries.
Rows tentative(const Aggregates& aggregates, int rows)
{
    std::vector<double> size(aggregates.count(), 0);
    for (int row = 0; row < rows; ++row)
        if (aggregates.of(row) != kNone)
            size[aggregates.of(row)] += 1;
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < rows; ++row)
        if (aggregates.of(row) != kNone)
            entries.emplace_back(row, static_cast<int>(aggregates.of(row)),
                             1 / std::sqrt(size[aggregates.of(row)]));
    Rows out(rows, static_cast<int>(aggregates.count()));
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

Rows smoothed(const Rows& tentative, const Rows& strong)
{
    const Eigen::VectorXd inverse = divisor(strong).cwiseInverse();
    const auto rows = static_cast<std::size_t>(strong.rows());
    const auto entries = static_cast<std::size_t>(strong.nonZeros()); // setFromTriplets left no gaps
    const double highest =
        gershgorin<int>({strong.outerIndexPtr(), rows + 1}, {strong.innerIndexPtr(), entries},
                        {strong.valuePtr(), entries}, {inverse.data(), rows});
    const Eigen::VectorXd scale = (-kSmoothing / highest) * inverse;
    Rows image = strong * tentative;
    for (int row = 0; row < image.outerSize(); ++row)
        for (Rows::InnerIterator it(image, row); it; ++it)
            it.valueRef() *= scale[row];
    return tentative + image;
}

std::vector<double> pseudo_inverse(const Rows& a)
{
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(a)};
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
    AggregationHierarchy out;
    Rows a = to_eigen(matrix);
    double strength = options.strength;
    for (int level = 1; level < options.most_levels && a.rows() > static_cast<int>(options.coarsest); ++level)
    {
        const Rows strong = filtered(a, strength);
        const Aggregates aggregates(strong);
        if (aggregates.count() == 0 || aggregates.count() > kLeastShrinking * static_cast<double>(a.rows()))
            break;
        const Rows prolongation = smoothed(tentative(aggregates, static_cast<int>(a.rows())), strong);
        const Rows restriction = prolongation.transpose();
        out.levels.push_back({from_eigen(a), from_eigen(prolongation), from_eigen(restriction)});
        const Rows half = a * prolongation;
        Rows coarse = restriction * half;
        const Rows mirrored = coarse.transpose();
        a = 0.5 * (coarse + mirrored); // exactly symmetric, which rounding of the product is not
        strength /= 2;
    }
    if (a.rows() > static_cast<int>(kMostCoarse))
        throw Error(ErrorCode::limit, "aggregation stops at " + std::to_string(a.rows()) +
                                          " rows, and a direct solve "
                                          "of more than " +
                                          std::to_string(kMostCoarse) +
                                          " is too much: take another preconditioner");
    out.levels.push_back({from_eigen(a), {}, {}});
    out.coarsest_inverse = pseudo_inverse(a);
    return out;
}

} // namespace taut::linear
