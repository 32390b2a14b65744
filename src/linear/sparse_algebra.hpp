#pragma once
// Products, sums and transposes of sparse matrices on the host; but for transposes rows are shared out among
// threads. Internal: for the set-up of preconditioners. The answers do not depend on the number of threads.

#include "taut/linear/sparse.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace taut::linear {

/// Calls body(first, last) for blocks of rows, first..last-1, that together are 0..rows-1, on as many threads
/// as the machine has and the system gives; at once, and in any order. Throws what `body` threw first.
void for_row_blocks(std::uint32_t rows, const std::function<void(std::uint32_t, std::uint32_t)>& body);

/// Writes one row: appends its columns, ascending, and their values.
using RowWriter =
    std::function<void(std::uint32_t row, std::vector<std::uint32_t>& column, std::vector<double>& value)>;

/// A matrix by its rows. `make_writer` is called once a thread, so that a writer may have a memory of its
/// own. Throws Error{limit} for 2^32 - 1 entries or more.
SparseMatrix build_rows(std::uint32_t rows, std::uint32_t columns,
                        const std::function<RowWriter()>& make_writer);

/// A B. Every entry is the sum of a_ik b_kj in order of k; all that some k contributes to are
/// there, also those that add up to 0. `a.columns` must be `b.rows`.
/// Gustavson. Two Fast Algorithms for Sparse Matrices: Multiplication and Permuted Transposition. TOMS 4(3),
/// 1978.
SparseMatrix product(const SparseMatrix& a, const SparseMatrix& b);

/// A + B, of one shape.
SparseMatrix sum(const SparseMatrix& a, const SparseMatrix& b);

SparseMatrix transpose(const SparseMatrix&);

/// One number a row, 0 where there is no entry.
std::vector<double> diagonal(const SparseMatrix&);

} // namespace taut::linear
