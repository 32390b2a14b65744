#pragma once
// Symmetric matrices of 3 x 3 blocks, a row a vertex: what solves of a whole scene on the host keep.

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace taut::reference {

/// 3 x N: a column a vertex.
using Columns = Eigen::Matrix3Xd;

/// The lower triangle in rows. Values are added after the pattern stands.
class BlockMatrix
{
public:
    using Pair = std::function<void(std::uint32_t a, std::uint32_t b)>;
    /// `pairs` names the two vertices of each block that is not zero, in any order and as often as it likes,
    /// the same ones each time that it is called (twice). The diagonal needs no naming.
    BlockMatrix(std::uint32_t rows, const std::function<void(const Pair&)>& pairs);

    /// To the block at (a, b); nothing where it lies above the diagonal. It must be in the pattern.
    void add(std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block);

    std::uint32_t rows() const { return static_cast<std::uint32_t>(diagonal_.size()); }
    const Eigen::Matrix3d& diagonal(std::uint32_t row) const { return diagonal_[row]; }
    /// Calls visit(column, block) for each block of a row below the diagonal.
    template <typename Visit>
    void each_below(std::uint32_t row, const Visit& visit) const
    {
        for (std::uint32_t at = start_[row]; at < start_[row + 1]; ++at)
            visit(column_[at], value_[at]);
    }

    Columns times(const Columns& x) const;
    /// Of the blocks below the diagonal alone.
    Columns below_times(const Columns& x) const;

private:
    void keep_one_each(const std::vector<std::uint32_t>& last);

    std::vector<Eigen::Matrix3d> diagonal_, value_;
    std::vector<std::uint32_t> start_, column_;
};

} // namespace taut::reference
