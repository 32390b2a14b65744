// Products, sums and transposes of sparse matrices against dense ones, and rows that threads share.

#include "support/catch.hpp"

#include "taut/linear/sparse_algebra.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <map>
#include <random>

using namespace taut;
using namespace taut::linear;

namespace {

/// A third of the places taken, by small whole numbers: sums of products are exact.
SparseMatrix some(std::uint32_t rows, std::uint32_t columns, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<double> values;
    for (std::uint32_t k = 0; k < rows * columns; ++k)
        values.push_back(random() % 3 == 0 ? static_cast<double>(1 + random() % 9) : 0);
    return from_dense(rows, columns, values);
}

double entry(const SparseMatrix& a, std::uint32_t row, std::uint32_t column)
{
    for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
        if (a.column[k] == column)
            return a.value[k];
    return 0;
}

void check_ascending(const SparseMatrix& a)
{
    REQUIRE(a.row_start.size() == a.rows + std::size_t(1));
    REQUIRE(a.row_start.back() == a.column.size());
    REQUIRE(a.value.size() == a.column.size());
    for (std::uint32_t row = 0; row < a.rows; ++row)
        for (std::uint32_t k = a.row_start[row]; k + 1 < a.row_start[row + 1]; ++k)
            REQUIRE(a.column[k] < a.column[k + 1]);
}

} // namespace

TEST_CASE("a product of sparse matrices has the entries of the dense one", "[linear]")
{
    const SparseMatrix a = some(17, 23, 1), b = some(23, 11, 2), c = product(a, b);
    REQUIRE(c.rows == 17);
    REQUIRE(c.columns == 11);
    check_ascending(c);
    for (std::uint32_t i = 0; i < c.rows; ++i)
        for (std::uint32_t j = 0; j < c.columns; ++j)
        {
            double sum = 0;
            for (std::uint32_t k = 0; k < a.columns; ++k)
                sum += entry(a, i, k) * entry(b, k, j);
            CHECK(entry(c, i, j) == sum);
        }
}

TEST_CASE("sums and transposes of sparse matrices, with rows that are empty", "[linear]")
{
    SparseMatrix a = some(19, 13, 3), b = some(19, 13, 4);
    a = from_triplets(21, 13, to_triplets(a)); // the last two rows have nothing
    b = from_triplets(21, 13, to_triplets(b));
    const SparseMatrix both = sum(a, b), turned = transpose(a);
    check_ascending(both);
    check_ascending(turned);
    REQUIRE(turned.rows == 13);
    REQUIRE(turned.columns == 21);
    for (std::uint32_t i = 0; i < 21; ++i)
        for (std::uint32_t j = 0; j < 13; ++j)
        {
            CHECK(entry(both, i, j) == entry(a, i, j) + entry(b, i, j));
            CHECK(entry(turned, j, i) == entry(a, i, j));
        }
    CHECK(transpose(turned).value == a.value);
}

TEST_CASE("rows are formed once each, also where many blocks of them are shared out", "[linear]")
{
    constexpr std::uint32_t kRows = 100003;
    std::vector<int> times(kRows, 0);
    for_row_blocks(kRows, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t row = first; row < last; ++row)
            ++times[row];
    });
    CHECK(std::count(times.begin(), times.end(), 1) == kRows);

    std::vector<Triplet> chain; // the product with itself reaches two places further
    for (std::uint32_t row = 0; row + 1 < kRows; ++row)
        chain.push_back({row, row + 1, 2});
    const SparseMatrix a = from_triplets(kRows, kRows, chain), twice = product(a, a);
    REQUIRE(twice.nonzeros() == kRows - 2);
    for (std::uint32_t row = 0; row + 2 < kRows; ++row)
    {
        REQUIRE(twice.column[row] == row + 2);
        REQUIRE(twice.value[row] == 4);
    }
    CHECK(diagonal(product(transpose(a), a))[kRows - 1] == 4);
    CHECK(product(SparseMatrix{}, SparseMatrix{}).nonzeros() == 0);
}

TEST_CASE("threads change no bit: a product is that of one loop over rows, in order", "[linear]")
{
    SparseMatrix a = poisson3d(30); // 27,000 rows: more than a block
    for (std::size_t k = 0; k < a.value.size(); ++k)
        a.value[k] /= 3.0 + static_cast<double>(k % 7); // sums that round
    const SparseMatrix squared = product(a, a);
    std::vector<Triplet> serial;
    for (std::uint32_t row = 0; row < a.rows; ++row)
    {
        std::map<std::uint32_t, double> sums;
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
            for (std::uint32_t l = a.row_start[a.column[k]]; l < a.row_start[a.column[k] + 1]; ++l)
                sums[a.column[l]] += a.value[k] * a.value[l];
        for (const auto& [column, value] : sums)
            serial.push_back({row, column, value});
    }
    const SparseMatrix expected = from_triplets(a.rows, a.columns, serial);
    CHECK(squared.row_start == expected.row_start);
    CHECK(squared.column == expected.column);
    CHECK(squared.value == expected.value);
}

TEST_CASE("what a block of rows throws ends all of them and is thrown on", "[linear]")
{
    const auto fail = [](std::uint32_t first, std::uint32_t) {
        if (first > 0)
            throw Error(ErrorCode::limit, "too much");
    };
    CHECK_THROWS_WITH(for_row_blocks(100000, fail), "too much");
}
