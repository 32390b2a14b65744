#include "taut/linear/format.hpp"

#include "support/catch.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

using namespace taut;
using namespace taut::linear;

namespace {

/// rows x rows with `lengths` entries a row, from the diagonal on and round the end.
SparseMatrix with_lengths(const std::vector<std::uint32_t>& lengths)
{
    std::vector<Triplet> triplets;
    const auto rows = static_cast<std::uint32_t>(lengths.size());
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t k = 0; k < lengths[i]; ++k)
            triplets.push_back({i, (i + k) % rows, 1.0 + k});
    return from_triplets(rows, rows, triplets);
}

/// Full 3 x 3 blocks on a chain of `nodes`.
SparseMatrix chain_of_blocks(std::uint32_t nodes)
{
    std::vector<Triplet> triplets;
    for (std::uint32_t a = 0; a < nodes; ++a)
        for (std::uint32_t b = a == 0 ? 0 : a - 1; b < std::min(a + 2, nodes); ++b)
            for (std::uint32_t k = 0; k < 9; ++k)
                triplets.push_back({3 * a + k / 3, 3 * b + k % 3, 1});
    return from_triplets(3 * nodes, 3 * nodes, triplets);
}

} // namespace

TEST_CASE("every format has a word and every word a format", "[linear][format]")
{
    for (const Format format : all_formats())
        CHECK(format_from(to_string(format)) == format);
    CHECK(all_formats().size() == 6);
    CHECK(format_from("auto") == Format::automatic);
    CHECK_THROWS_WITH(format_from("csc"), Contains("\"csc\"") && Contains("\"bcsr3\""));
}

TEST_CASE("row statistics count what is there", "[linear][format]")
{
    const RowStatistics s = row_statistics(with_lengths({1, 2, 3, 6, 0, 0}));
    CHECK(s.rows == 6);
    CHECK(s.nonzeros == 12);
    CHECK(s.shortest == 0);
    CHECK(s.longest == 6);
    CHECK(s.mean == 2);
    CHECK(s.deviation == Approx(std::sqrt((1.0 + 0 + 1 + 16 + 4 + 4) / 6)));
    CHECK(s.sell_fill == Approx(12.0 / (32 * 6))); // one slice, as wide as its longest row
    CHECK(s.block_fill == Approx(12.0 / (9 * 4))); // two blocks in each block row
    CHECK(row_statistics(with_lengths({1, 1})).block_fill == 0);
    CHECK(row_statistics(chain_of_blocks(5)).block_fill == 1);
    CHECK(row_statistics(SparseMatrix()).nonzeros == 0);
}

TEST_CASE("sorting rows within windows of 256 fills slices", "[linear][format]")
{
    std::vector<std::uint32_t> lengths(512, 1);
    for (std::size_t i = 0; i < 512; i += 16) // two in each slice, were they not sorted
        lengths[i] = 10;
    const RowStatistics s = row_statistics(with_lengths(lengths));
    CHECK(s.nonzeros == 480 + 320);
    CHECK(s.sell_fill == Approx(800.0 / (2 * 32 * (10 + 7 * 1))));
}

TEST_CASE("bytes of a format are those of its arrays", "[linear][format]")
{
    const SparseMatrix a = with_lengths({1, 2, 3, 6, 0, 0});
    const std::map<Format, std::uint64_t> in_double = {
        {Format::dense, 36 * 8},
        {Format::coo, 12 * 16},
        {Format::csr, 14 * 12 + 7 * 4},            // an empty row holds one zero
        {Format::ell, 32 * 6 * 12},                // 32 rows, 6 wide
        {Format::sell, 32 * 6 * 12 + 8 + 24},      // one slice, and the order of rows
        {Format::bcsr3, 32 * 2 * (9 * 8 + 4) + 8}, // one slice of two blocks a block row
    };
    for (const auto& [format, bytes] : in_double)
    {
        CAPTURE(to_string(format));
        CHECK(matrix_bytes(format, a, Precision::float64) == bytes);
    }
    CHECK(matrix_bytes(Format::csr, a, Precision::float32) == 14 * 8 + 7 * 4);
    CHECK(matrix_bytes(Format::csr, a, Precision::float32, true) ==
          14 * 8 + 7 * 4); // float holds these values
    SparseMatrix b = a;
    b.value[3] = 0.1;
    CHECK(matrix_bytes(Format::csr, b, Precision::float32, true) == 14 * 12 + 7 * 4);
    CHECK_THROWS_AS(matrix_bytes(Format::bcsr3, with_lengths({1, 1}), Precision::float64), Error);
    CHECK_THROWS_AS(matrix_bytes(Format::automatic, a, Precision::float64), Error);
    std::vector<std::uint32_t> lengths(1000, 1);
    lengths[7] = 600; // one long row
    CHECK(matrix_bytes(Format::csr, with_lengths(lengths), Precision::float64) == 1599 * 12 + 1001 * 4 + 12);
}

TEST_CASE("auto chooses by the rows and says why", "[linear][format]")
{
    const auto choose = [](const SparseMatrix& a, bool gpu) { return choose_format(row_statistics(a), gpu); };
    const SparseMatrix poisson = poisson2d(40);
    CHECK(choose(poisson, false).format == Format::csr);
    CHECK_THAT(choose(poisson, false).reason, Contains("3 to 5 entries"));
    CHECK(choose(poisson, true).format == Format::sell);
    CHECK_THAT(choose(poisson, true).reason, Contains("padding"));
    CHECK(choose(chain_of_blocks(50), false).format == Format::bcsr3);
    CHECK(choose(chain_of_blocks(50), true).format == Format::bcsr3);
    CHECK_THAT(choose(chain_of_blocks(50), true).reason, Contains("100 %"));
    CHECK(choose(with_lengths(std::vector<std::uint32_t>(40, 30)), true).format == Format::dense);
    std::vector<std::uint32_t> uneven(1024, 1);
    for (std::size_t i = 0; i < 1024; i += 256)
        uneven[i] = 1000;
    CHECK(choose(with_lengths(uneven), true).format == Format::csr);
    RowStatistics endless;
    endless.rows = endless.longest = 5'000'000;
    endless.nonzeros = 10'000'000;
    CHECK(choose_format(endless, false).format == Format::coo);
    CHECK_THAT(choose_format(endless, false).reason, Contains("5000000"));
    CHECK(choose_format(RowStatistics(), false).format == Format::csr);
}
