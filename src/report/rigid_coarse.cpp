// Based on: Nicolaides. Deflation of Conjugate Gradients with Applications to Boundary Value Problems. SINUM
//   24, 1987 (a small system of motions that are constant by groups); Bulgakov, Kuhn. High-performance
//   multilevel iterative aggregation solver for large finite-element structural analysis problems. IJNME 38,
//   1995 (groups that move as rigid bodies).
// Departures: motions that a group's vertices cannot tell apart (a point turns to itself, a line about
//   itself) are left out by the eigenvalues of their Gram matrix.

#include "taut/report/rigid_coarse.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace taut::reference {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kSame = 1e-9; ///< of the largest eigenvalue: motions that no vertex can tell apart

/// Neighbours on both sides of the diagonal.
std::vector<std::vector<std::uint32_t>> neighbours(const BlockMatrix& a)
{
    std::vector<std::vector<std::uint32_t>> out(a.rows());
    for (std::uint32_t row = 0; row < a.rows(); ++row)
        a.each_below(row, [&](std::uint32_t column, const Eigen::Matrix3d&) {
            out[row].push_back(column);
            out[column].push_back(row);
        });
    return out;
}

/// [I turn_a]^T block [I turn_b].
Matrix6 moved_block(const Eigen::Matrix3d& turn_a, const Eigen::Matrix3d& block,
                    const Eigen::Matrix3d& turn_b)
{
    Matrix6 out;
    out.topLeftCorner<3, 3>() = block;
    out.topRightCorner<3, 3>().noalias() = block * turn_b;
    out.bottomLeftCorner<3, 3>().noalias() = turn_a.transpose() * block;
    out.bottomRightCorner<3, 3>().noalias() = turn_a.transpose() * out.topRightCorner<3, 3>();
    return out;
}

/// The blocks of a group's row of the small system, of groups up to its own.
class CoarseRow
{
public:
    Matrix6& at(std::uint32_t group)
    {
        for (auto& [column, block] : blocks_)
            if (column == group)
                return block;
        return blocks_.emplace_back(group, Matrix6(Matrix6::Zero())).second;
    }
    const std::vector<std::pair<std::uint32_t, Matrix6>>& blocks() const { return blocks_; }

private:
    std::vector<std::pair<std::uint32_t, Matrix6>> blocks_;
};

} // namespace

RigidCoarse::RigidCoarse(const BlockMatrix& a, const Columns& place, std::uint32_t size)
    : group_(a.rows(), kNone),
      arm_(3, a.rows())
{
    gather(a, size);
    find_motions(place);
    factor(a);
}

void RigidCoarse::gather(const BlockMatrix& a, std::uint32_t size)
{
    const std::vector<std::vector<std::uint32_t>> beside = neighbours(a);
    for (std::uint32_t seed = 0; seed < a.rows(); ++seed)
    {
        if (group_[seed] != kNone)
            continue;
        const auto number = static_cast<std::uint32_t>(groups_.size());
        std::vector<std::uint32_t>& found = groups_.emplace_back().vertices;
        found.push_back(seed);
        group_[seed] = number;
        for (std::size_t at = 0; at < found.size() && found.size() < size; ++at)
            for (const std::uint32_t next : beside[found[at]])
                if (group_[next] == kNone && found.size() < size)
                {
                    group_[next] = number;
                    found.push_back(next);
                }
    }
}

void RigidCoarse::find_motions(const Columns& place)
{
    for (Group& group : groups_)
    {
        for (const std::uint32_t v : group.vertices)
            group.centre += place.col(v) / static_cast<double>(group.vertices.size());
        double square = 0;
        for (const std::uint32_t v : group.vertices)
            square = std::max(square, (place.col(v) - group.centre).squaredNorm());
        group.radius = square > 0 ? std::sqrt(square) : 1;
        Matrix6 gram = Matrix6::Zero();
        for (const std::uint32_t v : group.vertices)
        {
            arm_.col(v) = (place.col(v) - group.centre) / group.radius;
            gram += moved_block(turn(v), Eigen::Matrix3d::Identity(), turn(v));
        }
        const Eigen::SelfAdjointEigenSolver<Matrix6> solver(gram);
        const Eigen::Index lost = (solver.eigenvalues().array() < kSame * solver.eigenvalues()[5]).count();
        const Eigen::Index kept = 6 - lost;
        group.basis = solver.eigenvectors().rightCols(kept) *
                      solver.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
        group.first = unknowns_;
        unknowns_ += kept;
    }
}

Eigen::Matrix3d RigidCoarse::turn(std::uint32_t vertex) const
{
    const Eigen::Vector3d d = arm_.col(vertex);
    return (Eigen::Matrix3d() << 0, d.z(), -d.y(), -d.z(), 0, d.x(), d.y(), -d.x(), 0).finished();
}

void RigidCoarse::factor(const BlockMatrix& a)
{
    std::vector<CoarseRow> rows(groups_.size());
    for (std::uint32_t v = 0; v < a.rows(); ++v)
    {
        const std::uint32_t own = group_[v];
        const Eigen::Matrix3d turn_v = turn(v);
        rows[own].at(own) += moved_block(turn_v, a.diagonal(v), turn_v);
        a.each_below(v, [&](std::uint32_t u, const Eigen::Matrix3d& block) {
            const Matrix6 moved = moved_block(turn_v, block, turn(u));
            const std::uint32_t other = group_[u];
            if (other < own)
                rows[own].at(other) += moved;
            else
                rows[other].at(own) += moved.transpose();
            if (other == own) // the block above the diagonal, too
                rows[own].at(own) += moved;
        });
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t g = 0; g < groups_.size(); ++g)
        for (const auto& [column, block] : rows[g].blocks())
        {
            const Group& other = groups_[column];
            const Eigen::MatrixXd small = groups_[g].basis.transpose() * block * other.basis;
            for (Eigen::Index r = 0; r < small.rows(); ++r)
                for (Eigen::Index c = 0; c < small.cols(); ++c)
                    if (groups_[g].first + r >= other.first + c)
                        entries.emplace_back(static_cast<int>(groups_[g].first + r),
                                             static_cast<int>(other.first + c), small(r, c));
        }
    Eigen::SparseMatrix<double> coarse(unknowns_, unknowns_);
    coarse.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(coarse);
}

void RigidCoarse::add_motion(const Columns& r, Columns& z) const
{
    if (factors_.info() != Eigen::Success)
        return;
    Eigen::VectorXd force(unknowns_);
    for (const Group& group : groups_)
    {
        Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
        for (const std::uint32_t v : group.vertices)
        {
            sum.head<3>() += r.col(v);
            sum.tail<3>() += turn(v).transpose() * r.col(v);
        }
        force.segment(group.first, group.basis.cols()) = group.basis.transpose() * sum;
    }
    const Eigen::VectorXd motion = factors_.solve(force);
    for (const Group& group : groups_)
    {
        const Eigen::Matrix<double, 6, 1> m = group.basis * motion.segment(group.first, group.basis.cols());
        for (const std::uint32_t v : group.vertices)
            z.col(v) += m.head<3>() + turn(v) * m.tail<3>();
    }
}

} // namespace taut::reference
