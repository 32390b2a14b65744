#pragma once
// What is wrong with a system before any work is done, in words.

#include "taut/linear/sparse.hpp"
#include "taut/runtime/device.hpp"

#include <string>

namespace taut::linear {

struct CheckOptions
{
    double asymmetry = 1e-6;        ///< largest |a_ij - a_ji| / sqrt(|a_ii a_jj|) that counts as rounding
    double consistency = 1e-10;     ///< largest |1.b| / (|1| |b|) of a system that A maps constants to zero
    bool project_constants = false; ///< the caller takes the constants out of b
    /// Rows that are kept at their start: their diagonal may be anything.
    std::span<const std::uint32_t> held = {};
};

/// Throws Error{bad_input} that names the row and the entry, counted from 0, unless the matrix is laid out
/// as SparseMatrix says: row_start of rows + 1 entries from 0 up to the number of columns stored, never
/// falling, as many values, and in every row columns that ascend strictly and are below `columns`. After it
/// every index in the matrix is safe to follow.
void check_structure(const SparseMatrix&);

/// Throws what check_structure throws, and Error{bad_input} that names row and column, counted from 0, and
/// values for: a matrix that is not
/// square or has no fitting b or x0, entries that are not finite, an entry without an equal mirror (the worst
/// one), a diagonal that is zero (unless the row is empty or zero and b is 0 there) or negative, an empty row
/// with b != 0 there (no solution), and a matrix that maps constants to zero with a b that is not orthogonal
/// to them (no solution). Rows of `held`: only their entries of A and x0 must be finite.
void check_system(const SparseMatrix&, std::span<const double> b, std::span<const double> x0,
                  const CheckOptions&);

/// Throws Error{unsupported} that names the device and what to take instead, unless it has 64-bit floats.
void require_float64(const DeviceInfo&);

/// Constants are in the null space: |sum_j a_ij| <= 1e-12 sum_j |a_ij| in every row. Judged row by row, so
/// that a small row that holds the others in place is not lost beside large ones. False for a matrix of no
/// rows.
bool maps_constants_to_zero(const SparseMatrix&);

} // namespace taut::linear
