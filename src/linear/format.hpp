#pragma once
// The formats that a device can hold a matrix in, and which one to take.

#include "taut/linear/sparse.hpp"
#include "taut/runtime/base/kernel_info.hpp"

#include <string>
#include <string_view>

namespace taut::linear {

enum class Format : std::uint8_t
{
    automatic, ///< choose_format decides
    dense,     ///< row-major, every entry
    coo,       ///< row, column, value; sorted by row
    csr,       ///< compressed rows
    ell,       ///< ELLPACK, column-major, padded to the longest row
    sell,      ///< SELL-C-sigma: slices of 32 rows, rows sorted by length within windows of 256
    bcsr3,     ///< 3 x 3 blocks in slices of 32 block rows
};
std::string_view to_string(Format);
/// Throws Error{bad_input} listing the words there are ("auto", "dense", "coo", "csr", "ell", "sell",
/// "bcsr3").
Format format_from(std::string_view word);

/// Every format that is not `automatic`, in the order above.
std::span<const Format> all_formats();

struct RowStatistics
{
    std::uint32_t rows = 0;
    std::uint64_t nonzeros = 0;
    std::uint32_t shortest = 0;
    std::uint32_t longest = 0;
    double mean = 0;
    double deviation = 0;  ///< standard deviation of the row length
    double block_fill = 0; ///< nonzeros / (9 x nonzero 3 x 3 blocks); 0 where rows is no multiple of 3
    double sell_fill = 0;  ///< nonzeros / stored entries of SELL-32-256
};
RowStatistics row_statistics(const SparseMatrix&);

/// Device bytes of the matrix alone: values, indices, tables. With `pairs` the low words of `mixed` too.
std::uint64_t matrix_bytes(Format, const SparseMatrix&, Precision, bool pairs = false);

/// ELL that stores more than this many times the entries is worth a note.
inline constexpr double kLargeEllWaste = 3;
/// Largest block fill below which bcsr3 is refused by `automatic`.
inline constexpr double kLeastBlockFill = 0.6;
/// `automatic` takes dense from this share of all places on: there a value with a column number (12 bytes)
/// costs as much as the values of all places.
inline constexpr double kLeastDenseShare = 2.0 / 3;
/// `automatic` takes sell, on a hardware GPU, from this fill on.
inline constexpr double kLeastSellFill = 0.75;

struct FormatChoice
{
    Format format = Format::csr;
    std::string reason; ///< a sentence with the statistics that decided
};

/// From row statistics, never from a measurement, so that it is the same everywhere.
FormatChoice choose_format(const RowStatistics&, bool hardware_gpu);

} // namespace taut::linear
