#include "taut/linear/multigrid.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/linear/reals.hpp"
#include "taut/linear/solve.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

std::vector<double> waves(std::uint32_t n, double speed)
{
    std::vector<double> v;
    for (std::uint32_t i = 0; i < n; ++i)
        v.push_back(std::sin(1 + speed * i) + 0.1);
    return v;
}

double dot(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// One V-cycle, and the partial sums of r.z.
struct Cycle
{
    std::vector<double> z;
    double rz = 0;
};

Cycle cycle(const std::string& selector, const SparseMatrix& a, const std::vector<double>& r,
            int exponent = 0)
{
    const auto device = test_device(selector);
    const auto matrix = DeviceMatrix::upload(device, a, {Format::csr, Precision::float64, false, exponent});
    const Multigrid multigrid(device, aggregate(a), matrix, exponent);
    const std::uint32_t groups = group_count_for(a.rows, device->info());
    BufferPtr in = device->make_buffer(a.rows * 8ull, "r"), out = device->make_buffer(a.rows * 8ull, "z");
    BufferPtr partials = device->make_buffer(groups * 8ull, "partials");
    write_reals(*device, in, r, Precision::float64);
    Recorder recorder(device);
    multigrid.record(recorder, {groups, nullptr, 0}, in, out, partials);
    recorder.finish()->replay();
    Cycle result{device->read<double>(out, a.rows)};
    for (const double partial : device->read<double>(partials, groups))
        result.rz += partial;
    return result;
}

} // namespace

TEST_CASE("aggregation shrinks a Laplacian and keeps what it does to constants", "[linear][multigrid]")
{
    const AggregationHierarchy hierarchy = aggregate(poisson2d(64));
    REQUIRE(hierarchy.levels.size() >= 3);
    CHECK(hierarchy.operator_complexity() < 1.7);
    for (std::size_t k = 0; k + 1 < hierarchy.levels.size(); ++k)
    {
        const AggregationLevel& level = hierarchy.levels[k];
        const SparseMatrix& coarse = hierarchy.levels[k + 1].matrix;
        CHECK(coarse.rows < level.matrix.rows / 2);
        REQUIRE(level.prolongation.rows == level.matrix.rows);
        REQUIRE(level.prolongation.columns == coarse.rows);
        // The Galerkin product: y.A_c x = (P y).A (P x).
        const std::vector<double> x = waves(coarse.rows, 0.3), y = waves(coarse.rows, 0.7);
        std::vector<double> px(level.matrix.rows), py(level.matrix.rows), apx(level.matrix.rows),
            ax(coarse.rows);
        multiply(level.prolongation, x, px);
        multiply(level.prolongation, y, py);
        multiply(level.matrix, px, apx);
        multiply(coarse, x, ax);
        CHECK(dot(y, ax) == Approx(dot(py, apx)).epsilon(1e-10));
        std::vector<double> back(coarse.rows);
        multiply(level.restriction, apx, back);
        CHECK(dot(y, back) == Approx(dot(py, apx)).epsilon(1e-10));
    }
    CHECK(hierarchy.levels.back().matrix.rows <= 256);
}

TEST_CASE("a V-cycle is symmetric and positive on every executor", "[linear][multigrid]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const SparseMatrix a = poisson2d(40);
    const std::vector<double> x = waves(a.rows, 0.31), y = waves(a.rows, 1.7);
    const Cycle vx = cycle(selector, a, x), vy = cycle(selector, a, y);
    CHECK(dot(y, vx.z) == Approx(dot(x, vy.z)).epsilon(1e-11));
    CHECK(dot(x, vx.z) > 0);
    CHECK(vx.rz == Approx(dot(x, vx.z)).epsilon(1e-12));
    CHECK(vx.z == cycle("cpu:serial", a, x).z);

    SECTION("and follows a scaling by a power of two bit for bit")
    {
        Cycle scaled = cycle(selector, a, x, -3);
        for (double& entry : scaled.z)
            entry /= 8;
        CHECK(scaled.z == vx.z);
    }
}

TEST_CASE("multigrid needs as many iterations for large systems as for small ones", "[linear][multigrid]")
{
    const auto device = test_device("cpu:serial");
    SolveOptions options;
    options.preconditioner = Preconditioner::multigrid;
    options.precision = GENERATE(SolvePrecision::float64, SolvePrecision::mixed);
    for (const SparseMatrix& a : {poisson2d(32), poisson2d(128), poisson3d(12), poisson3d(32)})
    {
        const std::vector<double> exact = waves(a.rows, 0.7);
        std::vector<double> b(a.rows);
        multiply(a, exact, b);
        const Solution solution = solve(device, a, b, options);
        CAPTURE(a.rows, solution.report.reason);
        CHECK(solution.report.status == Status::converged);
        CHECK(solution.report.iterations <= 12);
        CHECK(relative_residual(a, solution.x, b) <= 1e-8);
    }
}

TEST_CASE("multigrid on a system that is one level, or has rows of their own", "[linear][multigrid]")
{
    const auto device = test_device("cpu:serial");
    SolveOptions options;
    options.preconditioner = Preconditioner::multigrid;
    std::vector<Triplet> entries = to_triplets(poisson2d(20));
    for (std::uint32_t i = 400; i < 420; ++i)
        entries.push_back({i, i, 3.0});
    for (const SparseMatrix& a : {poisson2d(5), from_triplets(420, 420, entries)})
    {
        const std::vector<double> b = waves(a.rows, 0.7);
        const Solution solution = solve(device, a, b, options);
        CAPTURE(a.rows, solution.report.reason);
        CHECK(solution.report.status == Status::converged);
    }
}

TEST_CASE("multigrid refuses held rows", "[linear][multigrid]")
{
    SolveOptions options;
    options.preconditioner = Preconditioner::multigrid;
    options.held = {3};
    const SparseMatrix a = poisson2d(5);
    CHECK_THROWS_WITH(solve(test_device("cpu:serial"), a, waves(25, 1), options), Contains("no held rows"));
}

TEST_CASE("multigrid solves a system with rows that are zero", "[linear][multigrid]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const std::uint32_t n = GENERATE(12u, 48u); // a direct solve alone, and a hierarchy
    CAPTURE(selector, n);
    const SparseMatrix full = poisson2d(n);
    std::vector<Triplet> entries;
    for (Triplet t : to_triplets(full)) // every third row holds zeros, or nothing at all
        entries.push_back({t.row / 2 * 3 + t.row % 2, t.column / 2 * 3 + t.column % 2, t.value});
    const std::uint32_t rows = full.rows / 2 * 3;
    for (std::uint32_t row = 2; row < rows; row += 6)
        entries.push_back({row, row, 0});
    const SparseMatrix a = from_triplets(rows, rows, entries);
    std::vector<double> b = waves(rows, 0.4);
    for (std::uint32_t row = 2; row < rows; row += 3)
        b[row] = 0;
    SolveOptions options;
    options.preconditioner = Preconditioner::multigrid;
    options.tolerance = 1e-9;
    const Solution result = solve(test_device(selector), a, b, options);
    CHECK(result.report.status == Status::converged);
    CHECK(result.report.iterations < 25);
    CHECK(relative_residual(a, result.x, b) <= 1e-9);
    for (const AggregationLevel& level : aggregate(a).levels)
        for (const double value : level.prolongation.value)
            REQUIRE(std::isfinite(value));
}

TEST_CASE("aggregation refuses what its indices cannot number", "[linear][multigrid]")
{
    SparseMatrix a;
    a.rows = a.columns = 0x7fffffffu;
    CHECK_THROWS_WITH(aggregate(a), Contains("2147483647 rows") && Contains("there are 2147483647"));
}
