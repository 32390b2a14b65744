// D16: the same digits every time, and on every executor.

#include "linear_hard/cases.hpp"

using namespace taut;
using namespace taut::linear;

namespace {

/// Symmetric, random pattern and values, positive definite by its diagonal; rows are a multiple of 3.
SparseMatrix random_spd(std::uint32_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Triplet> t;
    Vector sums(n, 0.0);
    for (std::uint32_t k = 0; k < 4 * n; ++k)
    {
        const std::uint32_t i = random.below(n), j = random.below(n);
        if (i == j)
            continue;
        const double v = random.uniform(-1, 1);
        t.push_back({i, j, v});
        t.push_back({j, i, v});
        sums[i] += std::abs(v);
        sums[j] += std::abs(v);
    }
    for (std::uint32_t i = 0; i < n; ++i)
        t.push_back({i, i, 0.05 + 1.01 * sums[i]});
    return from_triplets(n, n, t);
}

void check_same(const Solution& a, const Solution& b)
{
    INFO(a.report.reason << " / " << b.report.reason);
    CHECK(same_bits(a.x, b.x));
    CHECK(a.report.iterations == b.report.iterations);
    CHECK(a.report.history == b.report.history);
    CHECK(a.report.status == b.report.status);
    CHECK(a.report.relative_residual == b.report.relative_residual);
}

} // namespace

TEST_CASE("D16: twenty solves have the same digits")
{
    const SparseMatrix a = random_spd(300, 41);
    Random random(42);
    const Vector b = random_vector(random, 300);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : {Format::automatic, Format::coo, Format::csr})
            {
                if (!is_cpu(*device) && (format == Format::csr || (format == Format::automatic) ==
                                                                      (precision == SolvePrecision::mixed)))
                    continue;
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                options.max_iterations = 60;
                options.keep_history = true;
                CAPTURE(words_of(options));
                const Solution first = solve_checked(device, a, b, options);
                CHECK(first.report.status == Status::converged);
                for (int turn = 1; turn < 20; ++turn)
                    check_same(first, solve(device, a, b, options));
            }
    });
}

TEST_CASE("every executor finds the same digits, iteration by iteration")
{
    struct Named
    {
        const char* name;
        SparseMatrix a;
    };
    const Named systems[] = {{"poisson2d(21)", poisson2d(21)}, // 441 rows: four groups
                             {"random of 1,500", random_spd(1500, 44)}};
    for (const Named& system : systems)
    {
        Random random(45);
        const Vector b = random_vector(random, system.a.rows), x0 = random_vector(random, system.a.rows);
        for (const SolvePrecision precision : kPrecisions)
            for (const Format format : {Format::automatic, Format::dense, Format::coo, Format::csr,
                                        Format::ell, Format::sell, Format::bcsr3})
                for (const Preconditioner kind : {Preconditioner::jacobi, Preconditioner::none,
                                                  Preconditioner::block_jacobi, Preconditioner::chebyshev})
                {
                    // Every preconditioner with one format; every format with Jacobi.
                    if (kind != Preconditioner::jacobi && format != Format::sell)
                        continue;
                    if (format == Format::dense && system.a.rows > 1000)
                        continue;
                    SolveOptions options;
                    options.format = format;
                    options.precision = precision;
                    options.preconditioner = kind;
                    options.tolerance = precision == SolvePrecision::float32 ? 1e-6 : 1e-10;
                    // Iterates that have not converged must agree, too.
                    options.max_iterations = driver_iterations(50);
                    options.keep_history = true;
                    CAPTURE(system.name, words_of(options));
                    const Solution serial =
                        solve_checked(test_device("cpu:serial"), system.a, b, options, x0);
                    CHECK(serial.report.history.size() == serial.report.iterations + 1);
                    on_every_device([&](const std::shared_ptr<Device>& device) {
                        if (bitwise_equal_expected(device->info()))
                            check_same(serial, solve(device, system.a, b, options, x0));
                    });
                }
    }
}
