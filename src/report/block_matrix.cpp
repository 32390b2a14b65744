#include "taut/report/block_matrix.hpp"

#include <algorithm>
#include <cassert>

namespace taut::reference {

BlockMatrix::BlockMatrix(std::uint32_t rows, const std::function<void(const Pair&)>& pairs)
    : diagonal_(rows, Eigen::Matrix3d::Zero()),
      start_(rows + 1, 0)
{
    pairs([&](std::uint32_t a, std::uint32_t b) { start_[std::max(a, b) + 1] += a != b; });
    for (std::uint32_t row = 0; row < rows; ++row)
        start_[row + 1] += start_[row];
    column_.resize(start_[rows]);
    std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
    pairs([&](std::uint32_t a, std::uint32_t b) {
        if (a != b)
            column_[next[std::max(a, b)]++] = std::min(a, b);
    });
    keep_one_each(next);
}

/// Sorts the columns of each row, `last` its end, and leaves each once.
void BlockMatrix::keep_one_each(const std::vector<std::uint32_t>& last)
{
    std::uint32_t kept = 0;
    for (std::uint32_t row = 0; row < rows(); ++row)
    {
        const auto first = column_.begin() + start_[row], end = column_.begin() + last[row];
        std::sort(first, end);
        start_[row] = kept;
        for (auto from = first; from != end; ++from)
            if (from == first || *from != *(from - 1))
                column_[kept++] = *from;
    }
    start_[rows()] = kept;
    column_.resize(kept);
    value_.assign(kept, Eigen::Matrix3d::Zero());
}

void BlockMatrix::add(std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block)
{
    if (a == b)
        diagonal_[a] += block;
    if (a <= b)
        return;
    std::uint32_t at = start_[a];
    while (at < start_[a + 1] && column_[at] != b)
        ++at;
    assert(at < start_[a + 1] && "the pattern has it");
    value_[at] += block;
}

Columns BlockMatrix::times(const Columns& x) const
{
    Columns out(3, x.cols());
    for (std::uint32_t row = 0; row < rows(); ++row)
    {
        const Eigen::Vector3d own = x.col(row);
        Eigen::Vector3d sum = diagonal_[row] * own;
        each_below(row, [&](std::uint32_t column, const Eigen::Matrix3d& block) {
            sum += block * x.col(column);
            out.col(column) += block.transpose() * own;
        });
        out.col(row) = sum;
    }
    return out;
}

Columns BlockMatrix::below_times(const Columns& x) const
{
    Columns out = Columns::Zero(3, x.cols());
    for (std::uint32_t row = 0; row < rows(); ++row)
        each_below(row, [&](std::uint32_t column, const Eigen::Matrix3d& block) {
            out.col(row) += block * x.col(column);
        });
    return out;
}

} // namespace taut::reference
