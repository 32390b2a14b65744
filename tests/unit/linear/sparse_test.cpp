// Matrices on the host against Eigen, and the judge of every solve against wider arithmetic.

#include "taut/linear/sparse.hpp"
#include "taut/runtime/base/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/SparseCore>

#include <cmath>
#include <functional>
#include <limits>

using namespace taut;
using namespace taut::linear;
using taut::conformance::Random;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Triplet> random_triplets(Random& random, std::uint32_t rows, std::uint32_t columns, std::size_t n)
{
    std::vector<Triplet> triplets;
    for (std::size_t k = 0; k < n; ++k)
        triplets.push_back({random.below(rows), random.below(columns), random.uniform(-1, 1)});
    return triplets;
}

std::vector<double> random_vector(Random& random, std::size_t n)
{
    std::vector<double> x(n);
    for (double& v : x)
        v = random.uniform(-1, 1);
    return x;
}

using EigenRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

EigenRows eigen_of(std::uint32_t rows, std::uint32_t columns, const std::vector<Triplet>& triplets)
{
    std::vector<Eigen::Triplet<double>> list;
    for (const Triplet& t : triplets)
        list.emplace_back(int(t.row), int(t.column), t.value);
    EigenRows a(rows, columns);
    a.setFromTriplets(list.begin(), list.end());
    return a;
}

/// Same pattern; values within `slack`, since Eigen may add duplicates in another order.
void require_equal(const SparseMatrix& a, const EigenRows& e, double slack)
{
    REQUIRE(a.rows == e.rows());
    REQUIRE(a.columns == e.cols());
    REQUIRE(a.row_start.size() == a.rows + std::size_t(1));
    REQUIRE(a.nonzeros() == std::uint64_t(e.nonZeros()));
    REQUIRE(a.value.size() == a.column.size());
    for (std::uint32_t i = 0; i <= a.rows; ++i)
        REQUIRE(a.row_start[i] == std::uint32_t(e.outerIndexPtr()[i]));
    for (std::size_t k = 0; k < a.nonzeros(); ++k)
    {
        REQUIRE(a.column[k] == std::uint32_t(e.innerIndexPtr()[k]));
        REQUIRE(std::abs(a.value[k] - e.valuePtr()[k]) <= slack);
    }
}

std::string message_of(const std::function<void()>& call, ErrorCode code)
{
    try
    {
        call();
    }
    catch (const Error& error)
    {
        CHECK(error.code() == code);
        return error.what();
    }
    FAIL("nothing was thrown");
    return {};
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("triplets in any order give the matrix that Eigen builds", "[sparse]")
{
    Random random(1);
    const std::uint32_t sizes[][2] = {{1, 1}, {1, 50}, {50, 1}, {7, 9}, {64, 64}, {300, 200}};
    for (const auto& [rows, columns] : sizes)
        for (const std::size_t n : {0u, 1u, 10u, 500u, 5000u})
        {
            const auto triplets = random_triplets(random, rows, columns, n);
            const SparseMatrix a = from_triplets(rows, columns, triplets);
            require_equal(a, eigen_of(rows, columns, triplets), 1e-13);
            const SparseMatrix again = from_triplets(rows, columns, to_triplets(a)); // the sorted way
            CHECK(again.row_start == a.row_start);
            CHECK(again.column == a.column);
            CHECK(again.value == a.value);
        }
}

TEST_CASE("entries of one place are summed in the order given, and counted", "[sparse]")
{
    // 1e16 + 1 - 1e16 is 0 in this order and 1 in no other.
    const std::vector<Triplet> triplets = {{1, 1, 1e16}, {0, 2, 5}, {1, 1, 1}, {1, 1, -1e16}, {2, 0, 0}};
    BuildNotes notes;
    const SparseMatrix a = from_triplets(3, 3, triplets, &notes);
    CHECK(a.row_start == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(a.column == std::vector<std::uint32_t>{2, 1, 0});
    CHECK(a.value == std::vector<double>{5, (1e16 + 1) - 1e16, 0});
    CHECK(notes.duplicates == 2);
    CHECK(notes.first_duplicate.row == 1);
    CHECK(notes.first_duplicate.column == 1);
    CHECK(notes.first_duplicate.value == 1);
    CHECK(notes.explicit_zeros == 2); // one given, one by cancellation
}

TEST_CASE("an entry outside of the matrix is named", "[sparse]")
{
    const std::vector<Triplet> down = {{0, 0, 1}, {2, 1, 1}}, right = {{0, 3, 1}};
    const std::string row = message_of([&] { from_triplets(2, 3, down); }, ErrorCode::bad_input);
    CHECK(contains(row, "entry 1 lies at row 2, column 1, outside of a matrix of 2 x 3"));
    const std::string column = message_of([&] { from_triplets(2, 3, right); }, ErrorCode::bad_input);
    CHECK(contains(column, "entry 0 lies at row 0, column 3"));
    CHECK(contains(column, "counted from 0"));
    CHECK(contains(message_of([&] { from_triplets(0, 0, right); }, ErrorCode::bad_input), "0 x 0"));
}

TEST_CASE("a matrix of no rows, and rows without entries", "[sparse]")
{
    const SparseMatrix none = from_triplets(0, 0, {});
    CHECK(none.row_start == std::vector<std::uint32_t>{0});
    CHECK(to_triplets(none).empty());
    CHECK(relative_residual(none, {}, {}) == 0);
    const std::vector<Triplet> one = {{2, 1, 4}};
    const SparseMatrix a = from_triplets(5, 5, one);
    CHECK(a.row_start == std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1});
    CHECK(a.row_length(2) == 1);
    CHECK(a.row_length(4) == 0);
}

TEST_CASE("a dense matrix leaves its zeros out", "[sparse]")
{
    const std::vector<double> values = {1, 0, -2, 0, 0, 0, 0, 3, -0.0};
    const SparseMatrix a = from_dense(3, 3, values);
    CHECK(a.row_start == std::vector<std::uint32_t>{0, 2, 2, 3});
    CHECK(a.column == std::vector<std::uint32_t>{0, 2, 1});
    CHECK(a.value == std::vector<double>{1, -2, 3});
    const std::string text = message_of([&] { from_dense(2, 3, values); }, ErrorCode::bad_input);
    CHECK(contains(text, "2 x 3 has 6 values, row by row, but there are 9"));
}

TEST_CASE("a product is Eigen's", "[sparse]")
{
    Random random(2);
    const auto triplets = random_triplets(random, 120, 80, 2000);
    const SparseMatrix a = from_triplets(120, 80, triplets);
    const auto x = random_vector(random, 80);
    std::vector<double> y(120, 7);
    multiply(a, x, y);
    const Eigen::VectorXd expected =
        eigen_of(120, 80, triplets) * Eigen::Map<const Eigen::VectorXd>(x.data(), 80);
    for (int i = 0; i < 120; ++i)
        CHECK(std::abs(y[std::size_t(i)] - expected[i]) < 1e-13);
    CHECK(contains(message_of([&] { multiply(a, y, y); }, ErrorCode::bad_input), "x has 120 entries"));
    CHECK(contains(message_of([&] { multiply(a, x, std::span(y).first(7)); }, ErrorCode::bad_input),
                   "y has 7"));
}

TEST_CASE("the residual is that of twice the precision", "[sparse]")
{
    Random random(3);
    const std::uint32_t n = 60;
    const auto triplets = random_triplets(random, n, n, 1500);
    const SparseMatrix a = from_triplets(n, n, triplets);
    const auto x = random_vector(random, n);
    std::vector<double> b(n), r(n);
    multiply(a, x, b); // so that b - A x cancels to rounding: the plain way has no digit right
    residual(a, x, b, r);
    double most = 0, plain_error = 0;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        long double exact = b[i];
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            // The product of two 53-bit numbers in two parts, each exact in long double.
            const double product = a.value[k] * x[a.column[k]];
            exact -= static_cast<long double>(product);
            exact -= static_cast<long double>(std::fma(a.value[k], x[a.column[k]], -product));
        }
        most = std::max(most, std::abs(r[i]));
        CHECK(std::abs(static_cast<long double>(r[i]) - exact) <= 1e-3L * std::abs(exact) + 1e-18L);
        plain_error = std::max(plain_error, std::abs(static_cast<double>(exact)));
    }
    CHECK(most > 1e-17); // a plain b - A x, summed as b was, is 0 everywhere
    CHECK(plain_error > 1e-17);
}

TEST_CASE("a residual that cancels by thirty digits keeps its value", "[sparse]")
{
    const std::vector<Triplet> triplets = {{0, 0, 1e15}, {0, 1, 1 + 0x1p-40}};
    const SparseMatrix a = from_triplets(1, 2, triplets);
    const std::vector<double> x = {1, 1 + 0x1p-41}, b = {1e15 + 1};
    std::vector<double> r(1);
    residual(a, x, b, r);
    CHECK(r[0] == -(0x1p-40 + 0x1p-41 + 0x1p-81));
}

TEST_CASE("a term that overflows gives infinity, not NaN", "[sparse]")
{
    const std::vector<Triplet> triplets = {{0, 0, 1e200}};
    const SparseMatrix a = from_triplets(1, 1, triplets);
    const std::vector<double> x = {1e200}, b = {1};
    std::vector<double> r(1);
    residual(a, x, b, r);
    CHECK(r[0] == -kInfinity);
    CHECK(relative_residual(a, x, b) == kInfinity);
}

TEST_CASE("norms neither overflow nor underflow", "[sparse]")
{
    CHECK(norm({}) == 0);
    for (const double scale : {1.0, 0x1p-1060, 0x1p-500, 0x1p500, 0x1p1000})
    {
        const std::vector<double> v = {3 * scale, 0, -4 * scale};
        CHECK(norm(v) == 5 * scale);
    }
    CHECK(norm(std::vector<double>{std::numeric_limits<double>::denorm_min()}) == 0x1p-1074);
    CHECK(norm(std::vector<double>{1.5e308, 1.5e308}) == kInfinity); // the norm itself is out of range
    CHECK(norm(std::vector<double>{1, -kInfinity}) == kInfinity);
    CHECK(std::isnan(norm(std::vector<double>{kInfinity, std::nan(""), 1})));
}

TEST_CASE("relative residuals: scale, zero right-hand side, held rows", "[sparse]")
{
    for (const double scale : {1.0, 0x1p-600, 0x1p600})
    {
        const std::vector<Triplet> triplets = {{0, 0, 2 * scale}, {1, 1, 2 * scale}};
        const SparseMatrix a = from_triplets(2, 2, triplets);
        const std::vector<double> b = {3 * scale, 4 * scale}, zero = {0, 0}, x = {1.5, 0.5};
        CHECK(relative_residual(a, zero, b) == 1);
        CHECK(relative_residual(a, x, b) == 3.0 / 5.0);
        CHECK(relative_residual(a, x, zero) == norm(std::vector<double>{3 * scale, scale}));
        const std::vector<std::uint32_t> held = {1};
        CHECK(relative_residual(a, x, b, held) == 0);
        CHECK(relative_residual(a, zero, b, held) == 1);
    }
    const std::vector<Triplet> triplets = {{0, 0, 1}};
    const std::vector<std::uint32_t> outside = {1};
    const std::vector<double> one = {1};
    CHECK(contains(message_of([&] { relative_residual(from_triplets(1, 1, triplets), one, one, outside); },
                              ErrorCode::bad_input),
                   "held row 1"));
}

TEST_CASE("Laplacians on grids are those of a plain loop", "[sparse]")
{
    for (const std::uint32_t n : {0u, 1u, 2u, 5u})
    {
        std::vector<Triplet> plane, box;
        const auto joined = [n](std::uint32_t p, std::uint32_t q) { // neighbours along one axis
            int distance = 0;
            for (int d = 0; d < 3; ++d, p /= n, q /= n)
                distance += std::abs(int(p % n) - int(q % n));
            return distance == 1;
        };
        for (std::uint32_t p = 0; p < n * n * n; ++p)
            for (std::uint32_t q = 0; q < n * n * n; ++q)
                if (p == q || joined(p, q))
                {
                    box.push_back({p, q, p == q ? 6.0 : -1.0});
                    if (p < n * n && q < n * n)
                        plane.push_back({p, q, p == q ? 4.0 : -1.0});
                }
        require_equal(poisson3d(n), eigen_of(n * n * n, n * n * n, box), 0);
        require_equal(poisson2d(n), eigen_of(n * n, n * n, plane), 0);
    }
    CHECK(poisson3d(100).nonzeros() == 7 * 1000000 - 6 * 10000);
}

TEST_CASE("grids whose Laplacian has too many entries are refused before memory is asked for", "[sparse]")
{
    for (const std::uint32_t n : {850u, 2642u, 2643u, 65536u, 4294967295u})
        CHECK(contains(message_of([&] { poisson3d(n); }, ErrorCode::limit), "4294967294"));
    for (const std::uint32_t n : {29309u, 65536u, 4294967295u})
        CHECK(contains(message_of([&] { poisson2d(n); }, ErrorCode::limit), "4294967294"));
}
