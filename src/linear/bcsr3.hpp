#pragma once
// Where the blocks of format bcsr3 lie: for kernels of a caller that write values on the device.

#include "taut/kernels/shared/bcsr3.h"
#include "taut/linear/sparse.hpp"

namespace taut::linear {

/// The pattern of 3 x 3 blocks. Block row i is row r = i % 32 of slice i / 32. Its k-th block is in step
/// t = slice_start[i / 32] + k; entry e = 3 p + q of it (row p, column q) is value
/// bcsr3_value(t, e, r) = (9 t + e) 32 + r, in kernels TAUT_BCSR3_VALUE of shared/bcsr3.h, which this is.
struct Bcsr3Layout
{
    std::vector<std::uint32_t> slice_start; ///< in steps; one more than there are slices
    std::vector<std::uint32_t> column;      ///< of blocks, at bcsr3_block(t, r); steps without a block say i
    std::uint64_t values() const { return std::uint64_t{9} * column.size(); }
};

/// Throws Error{bad_input} unless rows and columns are a multiple of 3, Error{limit} when values would be
/// 2^32 or more.
Bcsr3Layout bcsr3_layout(const SparseMatrix&);

inline std::uint32_t bcsr3_block(std::uint32_t step, std::uint32_t r) { return TAUT_BCSR3_BLOCK(step, r); }
inline std::uint32_t bcsr3_value(std::uint32_t step, std::uint32_t entry, std::uint32_t r)
{
    return TAUT_BCSR3_VALUE(step, entry, r);
}

/// For each entry of the matrix its value's index.
std::vector<std::uint32_t> bcsr3_slots(const SparseMatrix&, const Bcsr3Layout&);

} // namespace taut::linear
