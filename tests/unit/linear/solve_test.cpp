#include "taut/linear/solve.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

std::vector<double> waves(std::uint32_t n)
{
    std::vector<double> v;
    for (std::uint32_t i = 0; i < n; ++i)
        v.push_back(std::sin(1 + 0.7 * i) + 0.1);
    return v;
}

/// 2 and -1 with free ends: constants are mapped to zero.
SparseMatrix free_chain(std::uint32_t n)
{
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        entries.push_back({i, i, i == 0 || i + 1 == n ? 1.0 : 2.0});
        if (i + 1 < n)
            entries.insert(entries.end(), {{i, i + 1, -1.0}, {i + 1, i, -1.0}});
    }
    return from_triplets(n, n, entries);
}

SolveOptions big(Preconditioner kind = Preconditioner::jacobi)
{
    SolveOptions options;
    options.preconditioner = kind;
    options.one_group = GENERATE(true, false);
    return options;
}

} // namespace

TEST_CASE("a right-hand side of any size that double holds is solved", "[linear][solve]")
{
    SolveOptions options = big();
    options.precision = GENERATE(SolvePrecision::float64, SolvePrecision::mixed);
    const SparseMatrix a = poisson2d(4);
    const std::vector<double> exact = waves(a.rows);
    std::vector<double> b(a.rows);
    multiply(a, exact, b);
    const double factor = GENERATE(1e-300, 1e300, 4e307); // the length of the last is beyond double
    for (double& entry : b)
        entry *= factor;
    const Solution solution = solve(test_device("cpu:serial"), a, b, options);
    CHECK(solution.report.status == Status::converged);
    for (std::uint32_t i = 0; i < a.rows; ++i)
        CHECK(solution.x[i] / factor == Approx(exact[i]).epsilon(1e-6));
}

TEST_CASE("a right-hand side of the largest numbers is solved in every format", "[linear][solve]")
{
    constexpr double kLargest = 1.7e308; // two of them have no length in double
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < 30; ++i)
        entries.push_back({i, i, 1e5});
    const SparseMatrix a = from_triplets(30, 30, entries);
    SolveOptions options = big();
    options.precision = GENERATE(SolvePrecision::float64, SolvePrecision::mixed, SolvePrecision::float32);
    options.format =
        GENERATE(Format::dense, Format::coo, Format::csr, Format::ell, Format::sell, Format::bcsr3);
    CAPTURE(to_string(options.precision), to_string(options.format));
    const Solution solution =
        solve(test_device("cpu:serial"), a, std::vector<double>(a.rows, kLargest), options);
    CHECK(solution.report.status == Status::converged);
    for (const double x : solution.x)
        CHECK(x / 1e303 == Approx(1.7).epsilon(1e-6));
}

TEST_CASE("ell is used where it is asked for, with a note where it pads much", "[linear][solve]")
{
    SparseMatrix a = poisson2d(16);
    SolveOptions options;
    options.format = Format::ell;
    const std::vector<double> b(a.rows, 1.0);
    CHECK(solve(test_device("cpu:serial"), a, b, options).report.notes.empty());
    std::vector<Triplet> entries; // an arrow: one long row and column
    for (std::uint32_t i = 0; i < 200; ++i)
        entries.push_back({i, i, i == 0 ? 300.0 : 2.0});
    for (std::uint32_t i = 1; i < 200; ++i)
        entries.insert(entries.end(), {{0, i, -1.0}, {i, 0, -1.0}});
    a = from_triplets(200, 200, entries);
    const Solution solution = solve(test_device("cpu:serial"), a, std::vector<double>(200, 1.0), options);
    CHECK(solution.report.status == Status::converged);
    CHECK(solution.report.format == Format::ell);
    REQUIRE(solution.report.notes.size() == 1);
    CHECK_THAT(solution.report.notes[0], Contains("pads every row to 200 entries and stores 40000"));
}

TEST_CASE("a solution beyond double is refused", "[linear][solve]")
{
    SparseMatrix a = poisson2d(4);
    for (double& value : a.value)
        value *= 1e-3;
    const std::vector<double> b(a.rows, 1e308);
    CHECK_THROWS_WITH(solve(test_device("cpu:serial"), a, b), Contains("is beyond double"));
}

TEST_CASE("no other precision is advised for a solution that none holds", "[linear][solve]")
{
    const SparseMatrix a =
        from_triplets(3, 3, std::vector<Triplet>{{0, 0, 1e-300}, {1, 1, 1e-300}, {2, 2, 1e-300}});
    SolveOptions options = big();
    options.precision = SolvePrecision::float32;
    try
    {
        const SolveReport report =
            solve(test_device("cpu:serial"), a, std::vector<double>(3, 1.7e308), options).report;
        CHECK(report.status != Status::converged);
        CHECK_THAT(report.reason, Contains("x is beyond the largest double") && !Contains("go further"));
    }
    catch (const Error& error)
    {
        CHECK_THAT(error.what(), Contains("is beyond double"));
    }
}

TEST_CASE("solve on every executor, in every precision", "[linear][solve]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    SolveOptions options = big();
    options.precision = GENERATE(SolvePrecision::float64, SolvePrecision::mixed);
    CAPTURE(selector, to_string(options.precision), options.one_group);
    const SparseMatrix a = poisson2d(16);
    const std::vector<double> exact = waves(a.rows);
    std::vector<double> b(a.rows);
    multiply(a, exact, b);
    const Solution solution = solve(test_device(selector), a, b, options);
    CHECK(solution.report.status == Status::converged);
    CHECK(solution.report.one_group == options.one_group);
    CHECK(relative_residual(a, solution.x, b) <= 1e-8);
    CHECK(forward_error(solution.x, exact) < 1e-6);
}

TEST_CASE("a null space is taken out of b and of the change of x, nothing else", "[linear][solve]")
{
    const SparseMatrix a = free_chain(64);
    SolveOptions options = big();
    options.null_space = NullSpace::constants;
    const auto device = test_device("cpu:serial");
    std::vector<double> image(64), b(64);
    multiply(a, waves(64), image);
    b = image;
    for (double& entry : b)
        entry += 0.5;
    const std::vector<double> start(64, 3.0);
    const Solution solution = solve(device, a, b, options, start);
    CAPTURE(solution.report.reason);
    CHECK(solution.report.status == Status::converged);
    double mean = 0;
    for (const double entry : solution.x)
        mean += entry / 64;
    CHECK(mean == Approx(3).epsilon(1e-12));
    CHECK(relative_residual(a, solution.x, image) <= 1e-8);
    CHECK(solution.report.null_part == Approx(0.5 * 8 / norm(b)));
    CHECK(solution.report.residual_of_given_b == Approx(relative_residual(a, solution.x, b)));

    SECTION("a b that lies in it has no part outside")
    {
        const Solution none = solve(device, a, std::vector<double>(64, 1.1), options);
        CHECK(none.report.status == Status::zero_right_hand_side);
        CHECK(none.report.iterations == 0);
        CHECK(norm(none.x) == 0);
    }
    SECTION("and it is not mixed with held rows")
    {
        options.held = {0};
        CHECK_THROWS_AS(solve(device, a, b, options), Error);
    }
    SECTION("a vector that is not in the null space is refused")
    {
        options.null_space = NullSpace::given;
        options.null_vectors = {waves(64)};
        CHECK_THROWS_WITH(solve(device, a, b, options), Contains("not in the null space"));
    }
}

TEST_CASE("held rows keep their start to the last bit, also where they alone drive the system",
          "[linear][solve]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Preconditioner kind =
        GENERATE(Preconditioner::none, Preconditioner::jacobi, Preconditioner::chebyshev);
    SolveOptions options = big(kind);
    options.held = {0, 17, 63};
    CAPTURE(selector, to_string(kind), options.one_group);
    const SparseMatrix a = poisson2d(8);
    std::vector<double> start(64, 0), b(64, 0);
    start[0] = 0.1;
    start[17] = -3;
    start[63] = 1e-3;
    const double load = GENERATE(0.0, 1.0);
    for (double& entry : b)
        entry = load;
    const Solution solution = solve(test_device(selector), a, b, options, start);
    CAPTURE(solution.report.reason);
    CHECK(solution.report.status == Status::converged);
    for (const std::uint32_t row : options.held)
        CHECK(solution.x[row] == start[row]);
    std::vector<double> r(64);
    residual(a, solution.x, b, r);
    for (std::uint32_t row = 0; row < 64; ++row)
        if (row != 0 && row != 17 && row != 63)
            CHECK(std::abs(r[row]) < 1e-6);
}

TEST_CASE("a start that is far off is dropped with a note", "[linear][solve]")
{
    const SparseMatrix a = poisson2d(40);
    const std::vector<double> b = waves(a.rows);
    SolveOptions options = big();
    options.precision = GENERATE(SolvePrecision::float32, SolvePrecision::mixed, SolvePrecision::float64);
    options.tolerance = 1e-5;
    std::vector<double> start = waves(a.rows);
    for (double& entry : start)
        entry *= 1e25;
    const Solution solution = solve(test_device("cpu:serial"), a, b, options, start);
    CAPTURE(solution.report.reason);
    CHECK(solution.report.status == Status::converged);
    CHECK(solution.report.notes.size() == 1);
}

TEST_CASE("options that make no sense are refused in words", "[linear][solve]")
{
    const SparseMatrix a = poisson2d(4);
    const std::vector<double> b = waves(16);
    const auto device = test_device("cpu:serial");
    SolveOptions options;
    options.tolerance = GENERATE(0.0, 1.0, -1.0, std::nan(""));
    CHECK_THROWS_WITH(solve(device, a, b, options), Contains("between 0 and 1"));
    options.tolerance = 1e-3;
    options.held = {16};
    CHECK_THROWS_WITH(solve(device, a, b, options), Contains("held row 16"));
    options.held.clear();
    options.chebyshev_degree = 17;
    CHECK_THROWS_WITH(solve(device, a, b, options), Contains("1 to 16"));
}

TEST_CASE("a matrix of many decades is not called indefinite for what float makes of it")
{
    const double decades[] = {1e14, 1e-4, 1e16}; // D S D with the definite S of ones and 0.3
    const double s[3][3] = {{1, -0.3, 0.3}, {-0.3, 1, 0.3}, {0.3, 0.3, 1}};
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j)
            entries.push_back({i, j, decades[i] * s[i][j] * decades[j]});
    const std::vector<double> b = {0, 1e27, 0};
    SolveOptions options =
        big(GENERATE(Preconditioner::chebyshev, Preconditioner::jacobi, Preconditioner::none));
    options.precision = GENERATE(SolvePrecision::float32, SolvePrecision::mixed);
    const SolveReport report =
        solve(test_device("cpu:serial"), from_triplets(3, 3, entries), b, options).report;
    INFO(to_string(options.preconditioner) << ": " << to_string(report.status) << ", " << report.reason);
    CHECK(report.status != Status::converged); // |b - A x| is beyond float
    CHECK(report.status != Status::indefinite_matrix);
    if (options.preconditioner == Preconditioner::chebyshev)
        CHECK_THAT(report.reason, Contains("decades apart for this precision"));
}
