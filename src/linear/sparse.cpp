// Based on: Gustavson. Two fast algorithms for sparse matrices: multiplication and permuted transposition.
// 1978
//           (sorting triplets by two counting passes).
// Departures: the pass over columns is left out where the triplets come sorted by row and column already.

#include "taut/linear/sparse.hpp"
#include "taut/runtime/base/error.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace taut::linear {
namespace {

constexpr std::uint64_t kMostEntries = std::numeric_limits<std::uint32_t>::max() - 1ull;

void refuse_too_many(std::uint64_t entries)
{
    if (entries > kMostEntries)
        throw Error(ErrorCode::limit, "a sparse matrix holds at most 4294967294 entries, but there are " +
                                          std::to_string(entries) + " or more: split the system");
}

void refuse_out_of_range(std::uint32_t rows, std::uint32_t columns, std::span<const Triplet> triplets)
{
    for (std::size_t k = 0; k < triplets.size(); ++k)
    {
        const Triplet& t = triplets[k];
        if (t.row < rows && t.column < columns)
            continue;
        throw Error(ErrorCode::bad_input,
                    "entry " + std::to_string(k) + " lies at row " + std::to_string(t.row) + ", column " +
                        std::to_string(t.column) + ", outside of a matrix of " + std::to_string(rows) +
                        " x " + std::to_string(columns) + " (entries, rows and columns are counted from 0)");
    }
}

bool is_sorted(std::span<const Triplet> triplets)
{
    for (std::size_t k = 1; k < triplets.size(); ++k)
    {
        const Triplet &before = triplets[k - 1], &t = triplets[k];
        if (t.row < before.row || (t.row == before.row && t.column < before.column))
            return false;
    }
    return true;
}

/// Positions of the triplets in `order`, ascending by key; those of equal keys stay in their order.
template <class Key>
std::vector<std::uint32_t> counting_sort(const std::vector<std::uint32_t>& order, std::uint32_t keys, Key key)
{
    std::vector<std::uint32_t> start(std::size_t(keys) + 1, 0);
    for (const std::uint32_t k : order)
        ++start[key(k) + 1];
    for (std::size_t i = 0; i < keys; ++i)
        start[i + 1] += start[i];
    std::vector<std::uint32_t> sorted(order.size());
    for (const std::uint32_t k : order)
        sorted[start[key(k)]++] = k;
    return sorted;
}

std::vector<std::uint32_t> order_of(std::uint32_t rows, std::uint32_t columns,
                                    std::span<const Triplet> triplets)
{
    std::vector<std::uint32_t> order(triplets.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        order[k] = std::uint32_t(k);
    if (is_sorted(triplets))
        return order;
    order = counting_sort(order, columns, [&](std::uint32_t k) { return triplets[k].column; });
    return counting_sort(order, rows, [&](std::uint32_t k) { return triplets[k].row; });
}

/// On a grid of n^dimensions points, those of a row in order of their columns.
SparseMatrix laplacian(std::uint64_t n, int dimensions)
{
    const double most = (2.0 * dimensions + 1) * std::pow(double(n), dimensions); // a double does not wrap
    if (most > double(kMostEntries))
        refuse_too_many(kMostEntries + 1);
    const std::uint64_t strides[3] = {1, n, n * n};
    const std::uint64_t rows = dimensions == 3 ? n * n * n : n * n;
    SparseMatrix a;
    a.rows = a.columns = std::uint32_t(rows);
    a.row_start.reserve(rows + 1);
    a.column.reserve(std::size_t(most));
    a.value.reserve(std::size_t(most));
    const auto put = [&](std::uint64_t column, double value) {
        a.column.push_back(std::uint32_t(column));
        a.value.push_back(value);
    };
    for (std::uint64_t row = 0; row < rows; ++row)
    {
        const std::uint64_t at[3] = {row % n, row / n % n, row / (n * n)};
        for (int d = dimensions - 1; d >= 0; --d)
            if (at[d] > 0)
                put(row - strides[d], -1);
        put(row, 2.0 * dimensions);
        for (int d = 0; d < dimensions; ++d)
            if (at[d] + 1 < n)
                put(row + strides[d], -1);
        a.row_start.push_back(std::uint32_t(a.column.size()));
    }
    return a;
}

} // namespace

SparseMatrix from_triplets(std::uint32_t rows, std::uint32_t columns, std::span<const Triplet> triplets,
                           BuildNotes* notes)
{
    refuse_too_many(triplets.size());
    refuse_out_of_range(rows, columns, triplets);
    BuildNotes found;
    SparseMatrix a;
    a.rows = rows;
    a.columns = columns;
    a.row_start.assign(std::size_t(rows) + 1, 0);
    a.column.reserve(triplets.size());
    a.value.reserve(triplets.size());
    std::uint32_t last_row = rows;
    for (const std::uint32_t k : order_of(rows, columns, triplets))
    {
        const Triplet& t = triplets[k];
        if (t.row == last_row && t.column == a.column.back())
        {
            if (found.duplicates++ == 0)
                found.first_duplicate = t;
            a.value.back() += t.value;
            continue;
        }
        a.column.push_back(t.column);
        a.value.push_back(t.value);
        ++a.row_start[std::size_t(t.row) + 1];
        last_row = t.row;
    }
    for (std::size_t i = 0; i < rows; ++i)
        a.row_start[i + 1] += a.row_start[i];
    for (const double v : a.value)
        found.explicit_zeros += v == 0 ? 1 : 0;
    if (notes)
        *notes = found;
    return a;
}

SparseMatrix from_dense(std::uint32_t rows, std::uint32_t columns, std::span<const double> values)
{
    if (values.size() != std::uint64_t(rows) * columns)
        throw Error(ErrorCode::bad_input,
                    "a dense matrix of " + std::to_string(rows) + " x " + std::to_string(columns) + " has " +
                        std::to_string(std::uint64_t(rows) * columns) +
                        " values, row by row, but there are " + std::to_string(values.size()));
    std::uint64_t entries = 0;
    for (const double v : values)
        entries += v != 0 ? 1 : 0;
    refuse_too_many(entries);
    SparseMatrix a;
    a.rows = rows;
    a.columns = columns;
    a.row_start.reserve(std::size_t(rows) + 1);
    a.column.reserve(entries);
    a.value.reserve(entries);
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        for (std::uint32_t j = 0; j < columns; ++j)
        {
            const double v = values[std::size_t(i) * columns + j];
            if (v == 0)
                continue;
            a.column.push_back(j);
            a.value.push_back(v);
        }
        a.row_start.push_back(std::uint32_t(a.column.size()));
    }
    return a;
}

std::vector<Triplet> to_triplets(const SparseMatrix& a)
{
    std::vector<Triplet> triplets;
    triplets.reserve(a.nonzeros());
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            triplets.push_back({i, a.column[k], a.value[k]});
    return triplets;
}

SparseMatrix poisson3d(std::uint32_t n) { return laplacian(n, 3); }

SparseMatrix poisson2d(std::uint32_t n) { return laplacian(n, 2); }

} // namespace taut::linear
