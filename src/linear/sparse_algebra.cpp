// Based on: Gustavson. Two Fast Algorithms for Sparse Matrices. TOMS 4(3), 1978.
// Departures: blocks of rows are formed by threads and joined in order; columns of a row are sorted.
// Transposes are formed by one thread.

#include "taut/linear/sparse_algebra.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/in_parallel.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace taut::linear {
namespace {

constexpr std::uint32_t kBlock = 16384; ///< rows: a thread that is late holds the others up by no more

std::uint32_t blocks_of(std::uint32_t rows) { return rows / kBlock + (rows % kBlock != 0 ? 1 : 0); }

/// Rows of one block, before it is known where they begin.
struct Block
{
    std::vector<std::uint32_t> length, column;
    std::vector<double> value;
};

/// The sum of rows that are scaled, of which the columns are few among many.
class RowSum
{
public:
    explicit RowSum(std::uint32_t columns) : in_(columns, false), sum_(columns) {}

    void add(std::uint32_t column, double value)
    {
        if (in_[column])
        {
            sum_[column] += value;
            return;
        }
        in_[column] = true;
        sum_[column] = value;
        used_.push_back(column);
    }

    void write(std::vector<std::uint32_t>& column, std::vector<double>& value)
    {
        std::sort(used_.begin(), used_.end());
        for (const std::uint32_t j : used_)
        {
            column.push_back(j);
            value.push_back(sum_[j]);
            in_[j] = false;
        }
        used_.clear();
    }

private:
    std::vector<char> in_;
    std::vector<double> sum_;
    std::vector<std::uint32_t> used_;
};

/// Where every row begins, and the last one ends. Throws Error{limit}.
std::vector<std::uint32_t> starts_of(const std::vector<Block>& blocks)
{
    std::vector<std::uint32_t> out = {0};
    std::uint64_t entries = 0;
    for (const Block& block : blocks)
        for (const std::uint32_t length : block.length)
        {
            entries += length;
            if (entries >= 0xffffffffu)
                throw Error(
                    ErrorCode::limit,
                    "a matrix of a preconditioner's set-up has 4294967295 entries or more: take another "
                    "preconditioner");
            out.push_back(static_cast<std::uint32_t>(entries));
        }
    return out;
}

} // namespace

void for_row_blocks(std::uint32_t rows, const std::function<void(std::uint32_t, std::uint32_t)>& body)
{
    in_parallel(blocks_of(rows), [&](std::uint32_t k) {
        const std::uint32_t first = k * kBlock;
        body(first, first + std::min(rows - first, kBlock));
    });
}

SparseMatrix build_rows(std::uint32_t rows, std::uint32_t columns,
                        const std::function<RowWriter()>& make_writer)
{
    std::vector<Block> blocks(blocks_of(rows));
    std::mutex guard;
    std::vector<RowWriter> idle;
    const auto take = [&] {
        const std::lock_guard lock(guard);
        if (idle.empty())
            return make_writer();
        RowWriter writer = std::move(idle.back());
        idle.pop_back();
        return writer;
    };
    for_row_blocks(rows, [&](std::uint32_t first, std::uint32_t last) {
        Block& block = blocks[first / kBlock];
        RowWriter write = take();
        for (std::uint32_t row = first; row < last; ++row)
        {
            const std::size_t before = block.column.size();
            write(row, block.column, block.value);
            block.length.push_back(static_cast<std::uint32_t>(block.column.size() - before));
        }
        const std::lock_guard lock(guard);
        idle.push_back(std::move(write));
    });
    SparseMatrix out{rows, columns, starts_of(blocks), {}, {}};
    out.column.resize(out.row_start.back());
    out.value.resize(out.row_start.back());
    for_row_blocks(rows, [&](std::uint32_t first, std::uint32_t) {
        Block& block = blocks[first / kBlock];
        const auto at = static_cast<std::ptrdiff_t>(out.row_start[first]);
        std::copy(block.column.begin(), block.column.end(), out.column.begin() + at);
        std::copy(block.value.begin(), block.value.end(), out.value.begin() + at);
        block = {};
    });
    return out;
}

SparseMatrix product(const SparseMatrix& a, const SparseMatrix& b)
{
    return build_rows(a.rows, b.columns, [&]() -> RowWriter {
        return [&, sum = RowSum(b.columns)](std::uint32_t row, auto& column, auto& value) mutable {
            for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
                for (std::uint32_t l = b.row_start[a.column[k]]; l < b.row_start[a.column[k] + 1]; ++l)
                    sum.add(b.column[l], a.value[k] * b.value[l]);
            sum.write(column, value);
        };
    });
}

SparseMatrix sum(const SparseMatrix& a, const SparseMatrix& b)
{
    return build_rows(a.rows, a.columns, [&]() -> RowWriter {
        return [&](std::uint32_t row, auto& column, auto& value) {
            std::uint32_t k = a.row_start[row], l = b.row_start[row];
            const std::uint32_t k_end = a.row_start[row + 1], l_end = b.row_start[row + 1];
            while (k < k_end || l < l_end)
            {
                const bool first = l == l_end || (k < k_end && a.column[k] <= b.column[l]);
                const bool second = k == k_end || (l < l_end && b.column[l] <= a.column[k]);
                column.push_back(first ? a.column[k] : b.column[l]);
                value.push_back((first ? a.value[k] : 0) + (second ? b.value[l] : 0));
                k += first ? 1 : 0;
                l += second ? 1 : 0;
            }
        };
    });
}

SparseMatrix transpose(const SparseMatrix& a)
{
    SparseMatrix out{a.columns, a.rows, std::vector<std::uint32_t>(a.columns + std::size_t(1), 0), {}, {}};
    for (const std::uint32_t column : a.column)
        ++out.row_start[column + 1];
    for (std::uint32_t row = 0; row < out.rows; ++row)
        out.row_start[row + 1] += out.row_start[row];
    std::vector<std::uint32_t> next(out.row_start.begin(), out.row_start.end() - 1);
    out.column.resize(a.column.size());
    out.value.resize(a.value.size());
    for (std::uint32_t row = 0; row < a.rows; ++row)
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
        {
            const std::uint32_t at = next[a.column[k]]++;
            out.column[at] = row;
            out.value[at] = a.value[k];
        }
    return out;
}

std::vector<double> diagonal(const SparseMatrix& a)
{
    std::vector<double> out(a.rows, 0);
    for_row_blocks(a.rows, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t row = first; row < last; ++row)
            for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
                out[row] = a.column[k] == row ? a.value[k] : out[row];
    });
    return out;
}

} // namespace taut::linear
