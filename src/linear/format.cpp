// Based on:
//   Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented Processors. SC
//   2009. (which format suits which lengths of rows)
//   Kreutzer, Hager, Wellein, Fehske, Bishop. A Unified Sparse Matrix Data Format for Efficient General
//   Sparse Matrix-Vector Multiplication on Modern Processors with Wide SIMD Units. SISC 2014. (the fill of
//   SELL)
// Departures: limits on shares and fills (format.hpp) decide and no trial runs; ell is never chosen, and coo
//   only where csr refuses a row.

#include "taut/linear/format.hpp"

#include "taut/linear/device_formats.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::linear {
namespace {

constexpr std::array kFormats = {Format::dense, Format::coo,  Format::csr,
                                 Format::ell,   Format::sell, Format::bcsr3};
constexpr std::array<std::string_view, 7> kFormatWords = {"auto", "dense", "coo",  "csr",
                                                          "ell",  "sell",  "bcsr3"};

/// Number of 3 x 3 blocks that hold an entry, block row by block row. Rows are a multiple of 3.
std::vector<std::uint32_t> blocks_of(const SparseMatrix& matrix)
{
    std::vector<std::uint32_t> blocks(matrix.rows / 3, 0);
    std::vector<std::uint32_t> seen(matrix.columns / 3 + 1, 0); // by the block row before, plus 1
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
        for (std::uint32_t k = matrix.row_start[row]; k < matrix.row_start[row + 1]; ++k)
        {
            std::uint32_t& last = seen[matrix.column[k] / 3];
            blocks[row / 3] += last != row / 3 + 1 ? 1 : 0;
            last = row / 3 + 1;
        }
    return blocks;
}

/// Entries stored by slices of 32 units as wide as their widest.
std::uint64_t sliced(std::span<const std::uint32_t> lengths)
{
    std::uint64_t sum = 0;
    for (std::size_t begin = 0; begin < lengths.size(); begin += SellLayout::kSlice)
    {
        const std::size_t n = std::min<std::size_t>(lengths.size() - begin, SellLayout::kSlice);
        const auto slice = lengths.subspan(begin, n);
        sum += std::uint64_t{SellLayout::kSlice} * *std::max_element(slice.begin(), slice.end());
    }
    return sum;
}

std::uint64_t slices_of(std::uint64_t units) { return (units + SellLayout::kSlice - 1) / SellLayout::kSlice; }

/// What a format stores: entries with a value, and bytes of everything else.
struct Storage
{
    std::uint64_t values = 0, table_bytes = 0;
};

Storage csr_storage(const SparseMatrix& matrix)
{
    std::uint64_t stored = matrix.nonzeros(), longs = 0;
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
    {
        stored += matrix.row_length(row) == 0 ? 1 : 0;
        longs += matrix.row_length(row) > kLongRow ? 1 : 0;
    }
    return {stored, 4 * (matrix.rows + std::uint64_t{1}) + 4 * stored + 12 * longs};
}

Storage ell_storage(const SparseMatrix& matrix)
{
    std::uint64_t longest = 0;
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
        longest = std::max<std::uint64_t>(longest, matrix.row_length(row));
    const std::uint64_t stored = longest * slices_of(matrix.rows) * SellLayout::kSlice;
    return {stored, 4 * stored};
}

Storage bcsr3_storage(const SparseMatrix& matrix)
{
    if (matrix.rows % 3 != 0)
        throw Error(ErrorCode::bad_input,
                    "format bcsr3 needs a multiple of 3 rows, not " + std::to_string(matrix.rows));
    const std::uint64_t blocks = sliced(blocks_of(matrix));
    return {9 * blocks, 4 * blocks + 4 * (slices_of(matrix.rows / 3) + 1)};
}

Storage storage_of(Format format, const SparseMatrix& matrix)
{
    switch (format)
    {
    case Format::automatic: break;
    case Format::dense: return {std::uint64_t{matrix.rows} * matrix.columns, 0};
    case Format::coo: return {matrix.nonzeros(), 8 * matrix.nonzeros()};
    case Format::csr: return csr_storage(matrix);
    case Format::ell: return ell_storage(matrix);
    case Format::sell:
    {
        const SellLayout layout = sell_layout(matrix);
        return {layout.entries(), 4 * (layout.entries() + layout.slice_start.size() + matrix.rows)};
    }
    case Format::bcsr3: return bcsr3_storage(matrix);
    }
    throw Error(ErrorCode::bad_input, "bytes are those of a format, not of \"auto\"");
}

/// Whether `mixed` keeps low words: some value is none of float's.
bool needs_low_words(const SparseMatrix& matrix)
{
    return std::any_of(matrix.value.begin(), matrix.value.end(),
                       [](double value) { return static_cast<double>(static_cast<float>(value)) != value; });
}

} // namespace

std::string_view to_string(Format format) { return kFormatWords[static_cast<std::size_t>(format)]; }

Format format_from(std::string_view word)
{
    std::string words;
    for (std::size_t k = 0; k < kFormatWords.size(); ++k)
    {
        if (kFormatWords[k] == word)
            return static_cast<Format>(k);
        words += (k == 0 ? "\"" : ", \"") + std::string(kFormatWords[k]) + '"';
    }
    throw Error(ErrorCode::bad_input,
                "\"" + std::string(word) + "\" is no matrix format: take one of " + words);
}

std::span<const Format> all_formats() { return kFormats; }

RowStatistics row_statistics(const SparseMatrix& matrix)
{
    RowStatistics out;
    out.rows = matrix.rows;
    out.nonzeros = matrix.nonzeros();
    if (matrix.rows == 0)
        return out;
    out.mean = static_cast<double>(out.nonzeros) / out.rows;
    out.shortest = matrix.row_length(0);
    double squares = 0;
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
    {
        const std::uint32_t length = matrix.row_length(row);
        out.shortest = std::min(out.shortest, length);
        out.longest = std::max(out.longest, length);
        squares += (length - out.mean) * (length - out.mean);
    }
    out.deviation = std::sqrt(squares / out.rows);
    if (out.nonzeros == 0)
        return out;
    const auto share = [&](std::uint64_t stored) {
        return static_cast<double>(out.nonzeros) / static_cast<double>(stored);
    };
    out.sell_fill = share(sell_layout(matrix).entries());
    if (matrix.rows % 3 != 0)
        return out;
    std::uint64_t blocks = 0;
    for (const std::uint32_t n : blocks_of(matrix))
        blocks += n;
    out.block_fill = share(9 * blocks);
    return out;
}

std::uint64_t matrix_bytes(Format format, const SparseMatrix& matrix, Precision precision, bool pairs)
{
    const Storage storage = storage_of(format, matrix);
    const std::uint64_t words = pairs && needs_low_words(matrix) ? 2 : 1;
    return storage.values * real_bytes(precision) * words + storage.table_bytes;
}

FormatChoice choose_format(const RowStatistics& s, bool hardware_gpu)
{
    const double square = static_cast<double>(s.rows) * s.rows;
    const double share = s.rows == 0 ? 0 : static_cast<double>(s.nonzeros) / square;
    if (share >= kLeastDenseShare)
        return {Format::dense, "dense: " + shown(100 * share, 3) +
                                   " % of all places hold an entry, so that column "
                                   "numbers would cost more than the zeros"};
    if (s.longest > kLongestCsrRow)
        return {Format::coo, "coo: the longest row holds " + std::to_string(s.longest) +
                                 " entries, and csr takes " + std::to_string(kLongestCsrRow)};
    if (s.block_fill >= kLeastBlockFill)
        return {Format::bcsr3, "bcsr3: " + shown(100 * s.block_fill, 3) +
                                   " % of the places in its 3 x 3 blocks hold an entry"};
    const std::string rows = "rows hold " + std::to_string(s.shortest) + " to " + std::to_string(s.longest) +
                             " entries, " + shown(s.mean, 3) + " on average (deviation " +
                             shown(s.deviation, 3) + ")";
    if (hardware_gpu && s.sell_fill >= kLeastSellFill)
        return {Format::sell, "sell: " + rows + ", so that only " + shown(100 * (1 - s.sell_fill), 3) +
                                  " % of what it stores is padding"};
    if (hardware_gpu)
        return {Format::csr, "csr: " + rows + ", so that " + shown(100 * (1 - s.sell_fill), 3) +
                                 " % of what sell stores would be padding"};
    return {Format::csr, "csr: " + rows + ", and a CPU reads rows as they stand"};
}

} // namespace taut::linear
