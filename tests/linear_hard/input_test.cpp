// D07, D08, D12, D13, D14: systems that conjugate gradients cannot solve, and the smallest that they can.

#include "linear_hard/cases.hpp"

#include <array>
#include <limits>

using namespace taut;
using namespace taut::linear;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Implicit Euler on a bent chain of `links` springs in space, m/h^2 + k (n n^T + (1 - stretch^-1)(1 - n
/// n^T)). With `project` the second factor is not let below zero.
SparseMatrix chain(std::uint32_t links, double stretch, bool project)
{
    const double mass = 0.1, k = 1000;
    double across = 1 - 1 / stretch;
    if (project)
        across = std::max(across, 0.0);
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i < 3 * (links + 1); ++i)
        t.push_back({i, i, mass * 60 * 60});
    for (std::uint32_t l = 0; l < links; ++l)
    {
        const double angle = 0.3 * l;
        const std::array<double, 3> n = {std::cos(angle), std::sin(angle) * 0.8, std::sin(angle) * 0.6};
        for (std::uint32_t i = 0; i < 3; ++i)
            for (std::uint32_t j = 0; j < 3; ++j)
            {
                const double v = k * (n[i] * n[j] + across * ((i == j ? 1.0 : 0.0) - n[i] * n[j]));
                t.push_back({3 * l + i, 3 * l + j, v});
                t.push_back({3 * l + 3 + i, 3 * l + 3 + j, v});
                t.push_back({3 * l + i, 3 * l + 3 + j, -v});
                t.push_back({3 * l + 3 + i, 3 * l + j, -v});
            }
    }
    const std::uint32_t n = 3 * (links + 1);
    return from_triplets(n, n, t);
}

/// 5-point Laplacian with a wind along x.
SparseMatrix convection(std::uint32_t n, double wind)
{
    std::vector<Triplet> t = to_triplets(poisson2d(n));
    for (Triplet& e : t)
        if (e.row + 1 == e.column || e.row == e.column + 1)
            e.value += e.row < e.column ? wind : -wind;
    return from_triplets(n * n, n * n, t);
}

} // namespace

TEST_CASE("D07: negative diagonals are refused, hidden indefiniteness is met and said")
{
    Vector signs(64);
    for (std::size_t i = 0; i < signs.size(); ++i)
        signs[i] = i % 2 == 0 ? 1 : -1;
    // Blocks [1 2; 2 1] have eigenvalues 3 and -1.
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i < 66; i += 2)
        for (const auto& [r, c, v] : {Triplet{0, 0, 1}, {0, 1, 2}, {1, 0, 2}, {1, 1, 1}})
            t.push_back({i + r, i + c, v * (1 + 0.01 * i)});
    const SparseMatrix hidden = from_triplets(66, 66, t);
    Random random(21);
    const Vector b = random_vector(random, 66);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        CHECK(code_of([&] { solve(device, diagonal(signs), ones(64)); }) == ErrorCode::bad_input);
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : all_formats())
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                const Solution s = solve_checked(device, hidden, b, options);
                CAPTURE(words_of(options), s.report.reason);
                CHECK(s.report.status == Status::indefinite_matrix);
                CHECK(s.report.relative_residual <= 1); // best so far
            }
        SolveOptions small;
        CHECK(solve_checked(device, hidden, b, small).report.status == Status::indefinite_matrix);
    });
}

TEST_CASE("D07: implicit Euler with compressed springs is indefinite, with projection it is solved")
{
    // Compressed to 0.88 the diagonal stays positive; to 0.2 it does not.
    const SparseMatrix bad = chain(32, 0.88, false), worse = chain(32, 0.2, false),
                       good = chain(32, 0.2, true);
    Random random(22);
    const Vector b = random_vector(random, bad.rows);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Preconditioner kind :
                 {Preconditioner::none, Preconditioner::jacobi, Preconditioner::block_jacobi,
                  Preconditioner::chebyshev, Preconditioner::spai0})
            {
                SolveOptions options;
                options.format = Format::bcsr3;
                options.precision = precision;
                options.preconditioner = kind;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-9;
                const Solution s = solve_checked(device, good, b, options);
                CAPTURE(words_of(options), s.report.reason);
                CHECK(s.report.status == Status::converged);
            }
        SolveOptions options;
        for (const Format format : {Format::automatic, Format::bcsr3})
            for (const Preconditioner kind : {Preconditioner::none, Preconditioner::jacobi})
            {
                options.format = format;
                options.preconditioner = kind;
                const Solution s = solve_checked(device, bad, b, options);
                CAPTURE(words_of(options), s.report.reason);
                CHECK(s.report.status == Status::indefinite_matrix);
            }
        CHECK(code_of([&] { solve(device, worse, b, options); }) == ErrorCode::bad_input);
    });
}

TEST_CASE("D08: what is not symmetric is refused, down to a skew part of a thousandth")
{
    const SparseMatrix laplacian = poisson2d(12);
    SparseMatrix rounding = laplacian;
    rounding.value[1] *= 1 + 1e-9;
    on_every_device([&](const std::shared_ptr<Device>& device) {
        CHECK(code_of([&] { solve(device, convection(12, 0.5), ones(144)); }) == ErrorCode::bad_input);
        CHECK(code_of([&] { solve(device, convection(12, 1e-3), ones(144)); }) == ErrorCode::bad_input);
        SparseMatrix one = laplacian;
        one.value[1] *= 1 + 1e-3;
        CHECK(code_of([&] { solve(device, one, ones(144)); }) == ErrorCode::bad_input);
        CHECK(solve_checked(device, rounding, ones(144)).report.status == Status::converged);
        // Let through by the caller's word, it still ends in a true one.
        SolveOptions options;
        options.asymmetry = 1;
        solve_checked(device, convection(12, 1e-3), ones(144), options);
        options.max_iterations = 200;
        solve_checked(device, convection(12, 0.9), ones(144), options);
    });
}

TEST_CASE("negative definite is refused")
{
    on_every_device([&](const std::shared_ptr<Device>& device) {
        CHECK(code_of([&] { solve(device, scaled(poisson2d(12), -1), ones(144)); }) == ErrorCode::bad_input);
        CHECK(code_of([&] { solve(device, diagonal(Vector{-1}), ones(1)); }) == ErrorCode::bad_input);
    });
}

TEST_CASE("D12: values that are not finite are refused wherever they are")
{
    const SparseMatrix a = poisson2d(8);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const double value : {kNaN, kInfinity, -kInfinity})
        {
            for (const std::size_t k : {std::size_t{0}, a.value.size() - 1})
            {
                SparseMatrix wrong = a;
                wrong.value[k] = value;
                CHECK(code_of([&] { solve(device, wrong, ones(64)); }) == ErrorCode::bad_input);
            }
            Vector v = ones(64);
            v[63] = value;
            CHECK(code_of([&] { solve(device, a, v); }) == ErrorCode::bad_input);
            CHECK(code_of([&] { solve(device, a, ones(64), {}, v); }) == ErrorCode::bad_input);
            CHECK(v[0] == 1);
        }
    });
}

TEST_CASE("D13: the smallest systems, and starts that are the answer")
{
    const SparseMatrix one = diagonal(Vector{4});
    const SparseMatrix a = poisson2d(12);
    Vector exact(144);
    for (std::size_t i = 0; i < exact.size(); ++i)
        exact[i] = double(i % 7) - 3; // integers: every precision holds b and x exactly
    const Vector b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        const Solution none = solve(device, SparseMatrix{}, {});
        CHECK(none.x.empty());
        CHECK(none.report.status == Status::zero_right_hand_side);
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format :
                 {Format::automatic, Format::dense, Format::coo, Format::csr, Format::ell, Format::sell})
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                CAPTURE(words_of(options));
                const Solution single = solve_checked(device, one, Vector{2}, options);
                CHECK(single.report.status == Status::converged);
                CHECK(single.report.iterations == 1);
                CHECK(single.x == Vector{0.5});

                const Solution zero = solve_checked(device, a, Vector(144, 0.0), options, exact);
                CHECK(zero.report.status == Status::zero_right_hand_side);
                CHECK(zero.report.iterations == 0);
                CHECK(norm(zero.x) == 0);

                const Solution there = solve_checked(device, a, b, options, exact);
                CHECK(there.report.status == Status::converged);
                CHECK(there.report.iterations == 0);
                CHECK(there.x == exact);

                Vector beside = exact;
                beside[50] = precision == SolvePrecision::float64
                                 ? std::nextafter(beside[50], 9.0)
                                 : double(std::nextafter(float(beside[50]), 9.0f));
                options.tolerance = precision == SolvePrecision::float64 ? 1e-12 : 1e-6;
                const Solution near = solve_checked(device, a, b, options, beside);
                CHECK(near.report.status == Status::converged);
                CHECK(near.report.iterations <= 2);
            }
    });
}

TEST_CASE("after the residual was formed anew every preconditioner is applied to it")
{
    // One row is solved by one step; from so far a start, float's rounding of it asks for a second or third.
    const SparseMatrix one = diagonal(Vector{4});
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : {SolvePrecision::mixed, SolvePrecision::float64})
            for (const Preconditioner kind :
                 {Preconditioner::none, Preconditioner::jacobi, Preconditioner::chebyshev,
                  Preconditioner::spai0, Preconditioner::multigrid})
            {
                SolveOptions options;
                options.format = Format::csr;
                options.precision = precision;
                options.preconditioner = kind;
                options.tolerance = 1.5e-12;
                const Solution s = solve_checked(device, one, Vector{-0.76659}, options, Vector{6432.281});
                CAPTURE(words_of(options), s.report.reason);
                CHECK(s.report.status == Status::converged);
                CHECK(s.report.iterations <= 3);
            }
    });
}

TEST_CASE("a start just above the tolerance is solved, not called stagnated")
{
    const SparseMatrix a = poisson2d(12);
    Random random(23);
    const Vector exact = random_vector(random, 144), b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        SolveOptions options;
        options.precision = SolvePrecision::float64;
        options.tolerance = 1e-6;
        const Solution near = solve_checked(device, a, b, options);
        REQUIRE(near.report.status == Status::converged);
        for (const double share : {0.9999, 0.99, 0.9})
        {
            options.tolerance = near.report.relative_residual * share;
            const Solution s = solve_checked(device, a, b, options, near.x);
            CAPTURE(share, s.report.reason);
            CHECK(s.report.status == Status::converged);
        }
    });
}

TEST_CASE("D14: duplicates are summed, empty rows pass, and formats agree")
{
    // Every entry in three parts, in no order; rows 30 to 32 have no entry.
    Random random(24);
    std::vector<Triplet> t;
    for (const Triplet& e : to_triplets(poisson2d(10)))
    {
        const auto at = [](std::uint32_t i) { return i < 30 ? i : i + 3; };
        for (const double part : {0.5, 0.25, 0.25})
            t.push_back({at(e.row), at(e.column), e.value * part});
    }
    std::vector<Triplet> mixed;
    for (const std::uint32_t k : random.shuffled(std::uint32_t(t.size())))
        mixed.push_back(t[k]);
    BuildNotes notes;
    const SparseMatrix a = from_triplets(105, 105, mixed, &notes); // 103 and two empty ones: a multiple of 3
    CHECK(notes.duplicates == 2 * poisson2d(10).nonzeros());
    const Vector exact = random_vector(random, 105), b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
        {
            Vector first;
            for (const Format format : all_formats())
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-6 : 1e-11;
                const Solution s = solve_checked(device, a, b, options);
                CAPTURE(words_of(options), s.report.reason);
                CHECK(s.report.status == Status::converged);
                if (first.empty())
                    first = s.x;
                CHECK(forward_error(s.x, first) < (precision == SolvePrecision::float32 ? 1e-4 : 1e-9));
            }
        }
    });
}
