// What is wrong with a system, in words.

#include "taut/linear/check.hpp"
#include "taut/runtime/base/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <functional>
#include <limits>

using namespace taut;
using namespace taut::linear;
using taut::conformance::Random;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The sentence of the refusal; "" where the system passes.
std::string refusal(const SparseMatrix& a, const std::vector<double>& b, const std::vector<double>& x0 = {},
                    const CheckOptions& options = {})
{
    try
    {
        check_system(a, b, x0, options);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part)
{
    if (text.find(part) != std::string::npos)
        return true;
    WARN("message: \"" << text << "\"");
    return false;
}

SparseMatrix matrix(std::uint32_t n, const std::vector<Triplet>& triplets)
{
    return from_triplets(n, n, triplets);
}

std::vector<double> ones(std::size_t n) { return std::vector<double>(n, 1.0); }

/// The path Laplacian of n points with free ends: rows sum to zero.
SparseMatrix neumann(std::uint32_t n, double scale = 1)
{
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        for (const auto& [row, column, value] :
             {Triplet{i, i, 1}, {i, i + 1, -1}, {i + 1, i, -1}, {i + 1, i + 1, 1}})
            t.push_back({row, column, value * scale});
    return matrix(n, t);
}

SparseMatrix with(const SparseMatrix& a, std::initializer_list<Triplet> more)
{
    std::vector<Triplet> t = to_triplets(a);
    t.insert(t.end(), more);
    return matrix(a.rows, t);
}

} // namespace

TEST_CASE("sound systems pass", "[check]")
{
    CHECK(refusal(poisson2d(8), ones(64)).empty());
    CHECK(refusal(poisson3d(5), ones(125), ones(125)).empty());
    CHECK(refusal(matrix(0, {}), {}).empty());
    CHECK(refusal(matrix(1, {{0, 0, 1e-300}}), {1}).empty());
    CHECK(refusal(poisson2d(4), std::vector<double>(16, 0.0)).empty());
    CHECK(refusal(matrix(2, {{0, 0, 4}, {0, 1, 1}, {1, 0, 1}, {1, 1, 4}, {0, 1, 0.5}, {1, 0, 0.5}}), ones(2))
              .empty());
}

TEST_CASE("sizes that do not fit are named", "[check]")
{
    const SparseMatrix wide = from_triplets(3, 4, {});
    CHECK(contains(refusal(wide, ones(3)), "the matrix is 3 x 4"));
    CHECK(contains(refusal(poisson2d(2), ones(5)), "b has 5 entries, but the matrix has 4 rows"));
    CHECK(
        contains(refusal(poisson2d(2), ones(4), ones(3)), "x0 has 3 entries, but the matrix has 4 columns"));
    const std::vector<std::uint32_t> held = {4};
    CHECK(contains(refusal(poisson2d(2), ones(4), {}, {.held = held}), "held row 4"));
}

TEST_CASE("values that are not finite are named: D12", "[check]")
{
    const double nan = std::nan("");
    CHECK(contains(refusal(with(poisson2d(3), {{4, 7, nan}}), ones(9)), "a(4, 7) = nan is not finite"));
    CHECK(
        contains(refusal(with(poisson2d(3), {{8, 8, -kInfinity}}), ones(9)), "a(8, 8) = -inf is not finite"));
    CHECK(contains(refusal(poisson2d(3), {1, 1, nan, 1, 1, 1, 1, 1, 1}), "b(2) = nan is not finite"));
    CHECK(contains(refusal(poisson2d(2), ones(4), {1, 1, 1, kInfinity}), "x0(3) = inf is not finite"));
    CHECK(contains(refusal(poisson2d(2), ones(4), {1, 1, 1, kInfinity}), "counted from 0"));
}

TEST_CASE("a negative or zero diagonal: D07", "[check]")
{
    const std::string one = refusal(matrix(3, {{0, 0, 1}, {1, 1, -2.5}, {2, 2, 1}}), ones(3));
    CHECK(contains(one, "a(1, 1) = -2.5 is negative"));
    CHECK(contains(one, "the only negative one among 3 diagonal entries"));
    CHECK(contains(one, "counted from 0"));
    SparseMatrix all = poisson2d(3);
    for (double& v : all.value)
        v = -v;
    const std::string text = refusal(all, ones(9));
    CHECK(contains(text, "a(0, 0) = -4 is negative"));
    CHECK(contains(text, "the first of 9 negative ones among 9 diagonal entries"));
    CHECK(contains(text, "solve -A x = -b"));
    const SparseMatrix saddle = matrix(2, {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}});
    CHECK(contains(refusal(saddle, ones(2)),
                   "a(1, 1) is not stored, so it is 0, while row 1 has other entries"));
    CHECK(
        contains(refusal(with(saddle, {{1, 1, 0}}), ones(2)), "a(1, 1) is 0 while row 1 has other entries"));
}

TEST_CASE("an indefinite matrix with a positive diagonal is left to the solve", "[check]")
{
    CHECK(refusal(matrix(2, {{0, 0, 1}, {0, 1, 2}, {1, 0, 2}, {1, 1, 1}}), ones(2)).empty());
}

TEST_CASE("a convection matrix is not symmetric: D08", "[check]")
{
    const std::uint32_t n = 6;
    SparseMatrix a = poisson2d(n);
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            a.value[k] += a.column[k] == i + 1 ? 0.5 : a.column[k] + 1 == i ? -0.5 : 0;
    const std::string text = refusal(a, ones(a.rows));
    CHECK(contains(text, "not symmetric"));
    CHECK(contains(text, "a(0, 1) = -0.5, but a(1, 0) = -1.5"));
    CHECK(contains(text, "a difference of 0.25 of sqrt(a(0, 0) a(1, 1))"));
}

TEST_CASE("entries without a mirror are found wherever they lie", "[check]")
{
    // Every single entry off the diagonal of a random symmetric pattern, taken away in turn.
    Random random(5);
    const std::uint32_t n = 12;
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i < n; ++i)
        t.push_back({i, i, 10});
    for (int k = 0; k < 20; ++k)
    {
        const std::uint32_t i = random.below(n), j = random.below(n);
        if (i != j)
            t.insert(t.end(), {{i, j, 1}, {j, i, 1}});
    }
    const std::vector<Triplet> whole = to_triplets(matrix(n, t));
    CHECK(refusal(matrix(n, whole), ones(n)).empty());
    int tried = 0;
    for (std::size_t k = 0; k < whole.size(); ++k)
    {
        if (whole[k].row == whole[k].column)
            continue;
        std::vector<Triplet> rest = whole;
        rest.erase(rest.begin() + std::ptrdiff_t(k));
        const std::string i = std::to_string(whole[k].row), j = std::to_string(whole[k].column);
        const std::string text = refusal(matrix(n, rest), ones(n));
        CHECK(contains(text, "a(" + j + ", " + i + ") = "));
        CHECK(contains(text, "but a(" + i + ", " + j + ") is not stored, so it is 0"));
        ++tried;
    }
    CHECK(tried > 20);
}

TEST_CASE("the worst of several differences is named", "[check]")
{
    const SparseMatrix a = with(poisson2d(4), {{0, 1, 1e-3}, {9, 10, 3e-3}, {14, 15, 2e-3}});
    CHECK(contains(refusal(a, ones(16)), "a(9, 10) = -0.997, but a(10, 9) = -1"));
}

TEST_CASE("a skew part of 1e-3 is refused, one of 1e-9 is rounding", "[check]")
{
    const auto skewed = [](double part) { return with(poisson2d(5), {{3, 4, 4 * part}, {4, 3, -4 * part}}); };
    CHECK(contains(refusal(skewed(1e-3), ones(25)), "a difference of 0.002 of sqrt(a(3, 3) a(4, 4))"));
    CHECK(refusal(skewed(1e-9), ones(25)).empty());
    CHECK_FALSE(refusal(skewed(1e-9), ones(25), {}, {.asymmetry = 1e-10}).empty());
    CHECK(refusal(skewed(1e-3), ones(25), {}, {.asymmetry = 1e-2}).empty());
    // What counts is the scale of the two rows, not that of the matrix.
    const double s = 0x1p-60;
    const SparseMatrix small = matrix(3, {{0, 0, 1}, {1, 1, s}, {1, 2, s / 2}, {2, 1, s / 4}, {2, 2, s}});
    CHECK(contains(refusal(small, ones(3)), "a difference of 0.25 of"));
}

TEST_CASE("an explicit zero needs no mirror", "[check]")
{
    CHECK(refusal(with(poisson2d(3), {{0, 8, 0}}), ones(9)).empty());
}

TEST_CASE("a zero row passes where b is 0 and has no solution where it is not: D09", "[check]")
{
    const SparseMatrix empty = matrix(3, {{0, 0, 2}, {2, 2, 2}}),
                       stored = with(empty, {{1, 1, 0}, {1, 0, 0}});
    for (const SparseMatrix& a : {empty, stored})
    {
        CHECK(refusal(a, {1, 0, 1}).empty());
        const std::string text = refusal(a, {1, 7, 1});
        CHECK(contains(text, "row 1 of the matrix is zero, but b(1) = 7 is not"));
        CHECK(contains(text, "no x solves that"));
    }
    const SparseMatrix column_left = with(empty, {{0, 1, 1}}); // row 1 is zero, column 1 is not
    CHECK(contains(refusal(column_left, {1, 0, 1}), "not symmetric: a(0, 1) = 1, but a(1, 0) is not stored"));
}

TEST_CASE("a Neumann Laplacian needs a b without a mean: D06", "[check]")
{
    for (const double scale : {1.0, 1e30, 1e-30, 1e300})
    {
        const SparseMatrix a = neumann(64, scale);
        std::vector<double> b(64);
        for (std::size_t i = 0; i < 64; ++i)
            b[i] = scale * std::cos(3.14159265358979 * 5 * (double(i) + 0.5) / 64);
        CHECK(refusal(a, b).empty());
        std::vector<double> shifted = b;
        for (double& v : shifted)
            v += 0.1 * scale;
        CHECK(contains(refusal(a, shifted), "|1.b| / (|1| |b|) = 0.14"));
        CHECK(contains(refusal(a, std::vector<double>(64, scale)), "|1.b| / (|1| |b|) = 1 where"));
        CHECK(contains(refusal(a, shifted), "(null_space: constants)"));
        CHECK(refusal(a, shifted, {}, {.project_constants = true}).empty());
    }
    const std::vector<std::uint32_t> held = {0}; // one row held: the rest is definite
    CHECK(refusal(neumann(64), ones(64), {}, {.held = held}).empty());
}

TEST_CASE("matrices that map constants to zero are known as such", "[check]")
{
    CHECK(maps_constants_to_zero(neumann(50)));
    CHECK(maps_constants_to_zero(neumann(50, 1e300)));
    CHECK_FALSE(maps_constants_to_zero(poisson2d(50)));
    CHECK_FALSE(maps_constants_to_zero(matrix(0, {})));
    CHECK_FALSE(maps_constants_to_zero(matrix(1, {{0, 0, std::nan("")}})));
    // A free path of huge stiffness beside one grounded unknown is no singular matrix of constants.
    std::vector<Triplet> t = to_triplets(neumann(5, 1e20));
    t.push_back({5, 5, 1});
    CHECK_FALSE(maps_constants_to_zero(matrix(6, t)));
    CHECK(refusal(matrix(6, t), {1, -1, 0, 0, 0, 1}).empty());
}

TEST_CASE("held rows may hold anything finite", "[check]")
{
    const std::vector<std::uint32_t> held = {1};
    const SparseMatrix a = matrix(3, {{0, 0, 2}, {0, 1, 5}, {1, 1, -3}, {1, 2, 4}, {2, 2, 2}});
    CHECK_FALSE(refusal(a, ones(3)).empty());
    CHECK(refusal(a, {1, std::nan(""), 1}, {}, {.held = held}).empty());
    CHECK(contains(refusal(with(a, {{1, 1, kInfinity}}), ones(3), {}, {.held = held}), "a(1, 1) = inf"));
    CHECK(contains(refusal(a, ones(3), {0, kInfinity, 0}, {.held = held}), "x0(1) = inf"));
    CHECK(contains(refusal(with(a, {{0, 2, 1}}), ones(3), {}, {.held = held}), "not symmetric"));
}

TEST_CASE("differences and scales near the ends of the range do not overflow", "[check]")
{
    const double big = 1e308;
    CHECK(refusal(matrix(2, {{0, 0, big}, {0, 1, big}, {1, 0, big}, {1, 1, big}}), ones(2)).empty());
    const SparseMatrix opposite = matrix(2, {{0, 0, big}, {0, 1, big}, {1, 0, -big}, {1, 1, big}});
    CHECK(contains(refusal(opposite, ones(2)), "a difference of 2 of"));
}

TEST_CASE("a matrix that is not laid out as compressed rows is refused with row and entry", "[linear][check]")
{
    const SparseMatrix good = neumann(5); // rows of 2, 3, 3, 3 and 2 entries
    CheckOptions options;
    options.project_constants = true;
    const auto refused = [&](const std::function<void(SparseMatrix&)>& spoil) {
        SparseMatrix a = good;
        spoil(a);
        CHECK_THROWS_AS(check_structure(a), Error);
        return refusal(a, ones(a.rows), {}, options); // check_system looks there first
    };
    CHECK_NOTHROW(check_structure(good));
    CHECK_NOTHROW(check_structure(SparseMatrix()));
    CHECK(refusal(good, ones(5), {}, options).empty());
    CHECK(contains(refused([](SparseMatrix& a) { a.column[4] = 4'000'000'000u; }),
                   "entry 4 in row 1 is in column 4000000000, but the matrix has 5 columns"));
    CHECK(contains(refused([](SparseMatrix& a) { a.column[4] = 5; }), "column 5, but the matrix has 5"));
    CHECK(contains(refused([](SparseMatrix& a) { std::swap(a.column[2], a.column[3]); }),
                   "entry 3 in row 1 is in column 0 behind one in column 1"));
    CHECK(contains(refused([](SparseMatrix& a) { a.column[3] = a.column[2]; }), "none appears twice"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start.pop_back(); }),
                   "row_start has 5 entries, but a matrix of 5 rows has 6"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start.clear(); }), "row_start has 0 entries"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start.push_back(13); }), "row_start has 7 entries"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start[0] = 1; }), "begins with 1 instead of 0"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start[2] = 1; }),
                   "row 1 (from 0) begins at entry 2 and ends before entry 1"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start[2] = 4'000'000'000u; }),
                   "row 2 (from 0) begins at entry 4000000000"));
    CHECK(contains(refused([](SparseMatrix& a) { a.row_start[5] = 4'000'000'000u; }),
                   "row_start ends at 4000000000, and there are 13 columns and 13 values"));
    CHECK(contains(refused([](SparseMatrix& a) { a.value.pop_back(); }), "13 columns and 12 values"));
}
