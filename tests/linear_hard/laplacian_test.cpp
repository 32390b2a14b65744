// D01, D04, D05, D06, D09: Laplacians with known counts and values, badly scaled, without a unique answer.

#include "linear_hard/cases.hpp"

using namespace taut;
using namespace taut::linear;

namespace {

struct Golden
{
    std::uint32_t n;
    std::uint32_t loose, tight; ///< iterations to 1e-6 and 1e-10 in fp64
    double centre;
};
constexpr Golden kGolden[] = {{16, 25, 31, 21.1087062151447}, {32, 51, 66, 80.0452498320828}};

double centre(const Vector& x, std::uint32_t n) { return x[n / 2 * n + n / 2]; }

/// The tolerance that a precision is asked for.
double tolerance_of(SolvePrecision precision) { return precision == SolvePrecision::float32 ? 1e-6 : 1e-12; }

double mean(std::span<const double> v)
{
    double sum = 0;
    for (const double entry : v)
        sum += entry;
    return sum / double(v.size());
}

double length(std::span<const double> v) { return norm(v); }

} // namespace

TEST_CASE("D01: the Laplacian of 16 and 32 squared takes the golden iterations to the golden value")
{
    for (const Golden& golden : kGolden)
    {
        const SparseMatrix a = poisson2d(golden.n);
        const Vector b = ones(a.rows);
        on_every_device([&](const std::shared_ptr<Device>& device) {
            const bool whole = is_cpu(*device) || golden.n == 16;
            for (const Format format : {Format::automatic, Format::csr, Format::sell})
                for (const bool tight : {false, true})
                {
                    if (!whole && format == Format::sell)
                        continue;
                    SolveOptions options;
                    options.format = format; // automatic: one work group
                    options.precision = SolvePrecision::float64;
                    options.preconditioner = Preconditioner::none;
                    options.tolerance = tight ? 1e-10 : 1e-6;
                    const Solution s = solve_checked(device, a, b, options);
                    CAPTURE(golden.n, to_string(format), s.report.one_group);
                    CHECK(s.report.status == Status::converged);
                    CHECK(s.report.iterations == (tight ? golden.tight : golden.loose));
                    CHECK(centre(s.x, golden.n) == Approx(golden.centre).epsilon(tight ? 1e-9 : 1e-5));
                }
        });
    }
}

TEST_CASE("D01: every format and precision finds the golden centre")
{
    const Golden& golden = kGolden[0];
    const SparseMatrix a =
        with_entries(poisson2d(16), std::vector<Triplet>{{256, 256, 1}, {257, 257, 1}}, 258);
    Vector b = ones(258); // 258 = 3 x 86, so that block rows fit
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : all_formats())
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = tolerance_of(precision);
                const Solution s = solve_checked(device, a, b, options);
                CAPTURE(to_string(format), to_string(precision), s.report.reason);
                // Rounding x to float alone leaves a residual of 1e-6: there the word may be `stagnated`.
                CHECK((s.report.status == Status::converged ||
                       (precision == SolvePrecision::float32 && s.report.status == Status::stagnated)));
                CHECK(s.report.format == format);
                const double error = std::abs(centre(s.x, 16) / golden.centre - 1);
                CHECK(error < (precision == SolvePrecision::float32 ? 1e-6 : 1e-12));
                note("D01", *device, std::string(to_string(format)) + " " + std::string(to_string(precision)),
                     error);
            }
    });
}

TEST_CASE("D04: a diagonal preconditioner undoes a scaling of rows and columns")
{
    const SparseMatrix laplacian = poisson2d(24);
    const Vector plain_b = product(laplacian, ones(laplacian.rows));
    for (const double most : {1e4, 1e6})
    {
        // D L D y = D b is L x = b with x = D y: the iterates are the same, the norm that stops them is not.
        const Vector d = graded(laplacian.rows, most);
        const SparseMatrix a = congruent(laplacian, d);
        const Vector b = times(d, plain_b);
        on_every_device([&](const std::shared_ptr<Device>& device) {
            for (const SolvePrecision precision : {SolvePrecision::float64, SolvePrecision::mixed})
            {
                SolveOptions options;
                options.format = Format::sell;
                options.precision = precision;
                options.tolerance = 1e-8;
                options.max_iterations = 400;
                const Solution plain = solve_checked(device, laplacian, plain_b, options);
                const Solution s = solve_checked(device, a, b, options);
                CAPTURE(most, to_string(precision), s.report.reason, plain.report.iterations);
                CHECK(s.report.status == Status::converged);
                note("D04", *device, "iterations over the Laplacian's",
                     double(s.report.iterations) / plain.report.iterations);
                SolveOptions bare = options;
                bare.preconditioner = Preconditioner::none;
                CHECK(solve_checked(device, a, b, bare).report.status != Status::converged);

                options.tolerance = 1e-14;
                // Scaled by no powers of two, floats of the matrix are others: a few iterations more in
                // `mixed`.
                const double more = precision == SolvePrecision::mixed ? 1.3 : 1.2;
                options.max_iterations = static_cast<std::uint32_t>(more * plain.report.iterations);
                const Solution as_long = solve_checked(device, a, b, options);
                CHECK(judged_residual(laplacian, times(d, as_long.x), plain_b) <= 1e-8);
            }
        });
    }
}

TEST_CASE("D05: a consistent Neumann system is solved and the mean stays")
{
    const std::uint32_t n = 64;
    const SparseMatrix a = neumann(n);
    Random random(5);
    Vector b = product(a, random_vector(random, n));
    const Vector x0(n, 0.7);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : {Format::automatic, Format::csr})
                for (const NullSpace null_space : {NullSpace::none, NullSpace::constants})
                {
                    SolveOptions options;
                    options.format = format;
                    options.precision = precision;
                    options.preconditioner = Preconditioner::none;
                    options.null_space = null_space;
                    options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                    const Solution s = solve_checked(device, a, b, options, x0);
                    CAPTURE(to_string(precision), to_string(format), s.report.reason, s.report.iterations);
                    CHECK(s.report.status == Status::converged);
                    if (precision == SolvePrecision::float64)
                    {
                        CHECK(s.report.iterations >= 63);
                        CHECK(s.report.iterations <= 64);
                    }
                    CHECK(std::abs(mean(s.x) - 0.7) < 1e-5);
                    CHECK(s.report.notes.empty() == (null_space == NullSpace::constants));
                    note("D05", *device, "mean moved", std::abs(mean(s.x) - 0.7));
                }
    });
}

TEST_CASE("D06: an inconsistent Neumann system is refused, or projected where asked for")
{
    const std::uint32_t n = 64;
    const SparseMatrix a = neumann(n);
    Random random(6);
    const Vector consistent = product(a, random_vector(random, n));
    Vector b = consistent;
    for (double& entry : b)
        entry += 0.1;
    on_every_device([&](const std::shared_ptr<Device>& device) {
        CHECK(code_of([&] { solve(device, a, ones(n)); }) == ErrorCode::bad_input);
        CHECK(code_of([&] { solve(device, a, b); }) == ErrorCode::bad_input);
        SolveOptions options;
        options.null_space = NullSpace::constants;
        for (const SolvePrecision precision : kPrecisions)
        {
            options.precision = precision;
            options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
            const Solution s = solve(device, a, b, options);
            CAPTURE(s.report.reason);
            CHECK(s.report.status == Status::converged);
            CHECK(judged_residual(a, s.x, consistent) <= 1.001 * options.tolerance);
            CHECK(std::abs(mean(s.x)) < 1e-12 * length(s.x));
            CHECK(s.report.null_part == Approx(0.8 / length(b)).epsilon(1e-6));
            const Solution nothing = solve(device, a, ones(n), options); // all of b is null space
            CHECK(nothing.report.status == Status::zero_right_hand_side);
            CHECK(length(nothing.x) == 0);
        }
    });
}

TEST_CASE("D06: a null space that nobody told of does not run away")
{
    const std::uint32_t n = 60;
    Vector d(n);
    for (std::uint32_t i = 0; i < n; ++i)
        d[i] = 1 + 0.5 * std::sin(1.0 + i); // 1/d is mapped to zero
    const SparseMatrix a = congruent(neumann(n), d);
    Random random(7);
    const Vector exact = random_vector(random, n);
    const Vector consistent = product(a, exact);
    for (const double share : {1.0, 1e-3, 1e-6})
    {
        Vector b = consistent;
        for (std::uint32_t i = 0; i < n; ++i)
            b[i] += share / d[i];
        on_every_device([&](const std::shared_ptr<Device>& device) {
            for (const SolvePrecision precision : kPrecisions)
                for (const Format format : {Format::automatic, Format::sell})
                    for (const Preconditioner kind : {Preconditioner::none, Preconditioner::jacobi})
                    {
                        if (!is_cpu(*device) && (kind == Preconditioner::none || share != 1e-3))
                            continue;
                        SolveOptions options;
                        options.format = format;
                        options.precision = precision;
                        options.preconditioner = kind;
                        options.tolerance = 1e-8;
                        options.max_iterations = is_cpu(*device) ? 20000 : 500;
                        const Solution s = solve_checked(device, a, b, options);
                        CAPTURE(share, words_of(options), s.report.reason, s.report.iterations);
                        CHECK(s.report.status != Status::converged);
                        CHECK(s.report.status != Status::indefinite_matrix); // it is semidefinite
                        CHECK(length(s.x) < 1e5 * length(exact));
                        CHECK(s.report.relative_residual <= 1);
                        note("D06", *device, "norm over the exact one's", length(s.x) / length(exact));
                    }
        });
    }
}

TEST_CASE("D09: a zero row with b = 0 keeps its start, with b != 0 it is refused")
{
    const std::uint32_t n = 130, hole = 77;
    std::vector<Triplet> t;
    for (const Triplet& entry : to_triplets(poisson2d(10)))
        t.push_back({entry.row + (entry.row >= hole ? 1 : 0), entry.column + (entry.column >= hole ? 1 : 0),
                     entry.value});
    const SparseMatrix a = from_triplets(n, n, t); // rows 77 and 101 to 129 are empty
    Random random(9);
    Vector x0 = random_vector(random, n), exact = random_vector(random, n);
    const Vector b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format :
                 {Format::automatic, Format::coo, Format::csr, Format::ell, Format::sell, Format::dense})
                for (const Preconditioner kind :
                     {Preconditioner::none, Preconditioner::jacobi, Preconditioner::spai0})
                {
                    if (!is_cpu(*device) && kind == Preconditioner::none)
                        continue;
                    SolveOptions options;
                    options.format = format;
                    options.precision = precision;
                    options.preconditioner = kind;
                    options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                    const Solution s = solve_checked(device, a, b, options, x0);
                    CAPTURE(words_of(options), s.report.reason);
                    CHECK(s.report.status == Status::converged);
                    CHECK(s.x[hole] == x0[hole]);
                    CHECK(same_bits(std::span(s.x).subspan(101), std::span(x0).subspan(101)));
                }
        Vector wrong = b;
        wrong[hole] = 1e-30;
        CHECK(code_of([&] { solve(device, a, wrong); }) == ErrorCode::bad_input);
    });
}
