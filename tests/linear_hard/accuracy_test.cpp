// D02, D03, D15: spectra that grow too wide for a precision. What is said is true on both sides.

#include "linear_hard/cases.hpp"

#include <Eigen/Dense>

using namespace taut;
using namespace taut::linear;

namespace {

constexpr std::uint32_t kSize = 200;

/// Q diag(1 .. 1/kappa, in equal ratios) Q^T, with Q from the QR factors of a fixed random matrix.
SparseMatrix graded_spd(double kappa)
{
    static const Eigen::MatrixXd q = [] {
        Random random(2026);
        Eigen::MatrixXd g(kSize, kSize);
        for (Eigen::Index k = 0; k < g.size(); ++k)
        {
            const double u = random.uniform(1e-12, 1), v = random.uniform(0, 1);
            g.data()[k] = std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
        }
        return Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(g).householderQ());
    }();
    Eigen::VectorXd lambda(kSize);
    for (Eigen::Index i = 0; i < kSize; ++i)
        lambda[i] = std::pow(kappa, -double(i) / (kSize - 1));
    const Eigen::MatrixXd product = q * lambda.asDiagonal() * q.transpose();
    const Eigen::MatrixXd a = (product + product.transpose()) / 2;
    return from_dense(kSize, kSize, std::span(a.data(), std::size_t(a.size())));
}

SparseMatrix hilbert(std::uint32_t n)
{
    Vector values;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            values.push_back(1.0 / (i + j + 1));
    return from_dense(n, n, values);
}

/// Twenty rounding units of what a precision holds the vectors in; `mixed` as a solve would ask.
double tolerance_of(SolvePrecision precision)
{
    switch (precision)
    {
    case SolvePrecision::float32: return 20 * 0x1p-23;
    case SolvePrecision::float64: return 20 * 0x1p-52;
    default: return 1e-8;
    }
}

/// Up to here a precision has to make it (in the iterations allowed).
double widest(SolvePrecision precision)
{
    return precision == SolvePrecision::float32 ? 1e5 : precision == SolvePrecision::float64 ? 1e6 : 1e7;
}

SolveOptions plain(SolvePrecision precision, bool one_group, std::uint32_t most)
{
    SolveOptions options;
    options.format = one_group ? Format::automatic : Format::dense;
    options.precision = precision;
    options.preconditioner = Preconditioner::none;
    options.max_iterations = most;
    return options;
}

} // namespace

TEST_CASE("D02: forward errors follow the condition number, and then it is said")
{
    for (const double kappa : {1e1, 1e2, 1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12, 1e14})
    {
        const SparseMatrix a = graded_spd(kappa);
        Random random(11);
        const Vector exact = random_vector(random, kSize), b = product(a, exact);
        on_every_device([&](const std::shared_ptr<Device>& device) {
            const bool whole = device->info().executor == "cpu:serial";
            if (!whole && kappa != 1e2 && (kappa != 1e8 || !is_cpu(*device)))
                return;
            for (const SolvePrecision precision : kPrecisions)
            {
                const std::uint32_t most = !whole                                 ? 400
                                           : precision == SolvePrecision::mixed   ? 20000
                                           : precision == SolvePrecision::float64 ? 10000
                                                                                  : 5000;
                SolveOptions options = plain(precision, !whole && !is_cpu(*device), most);
                options.tolerance = tolerance_of(precision);
                const Solution s = solve_checked(device, a, b, options);
                const SolveReport& report = s.report;
                const double error = forward_error(s.x, exact);
                CAPTURE(kappa, to_string(precision), report.reason, report.iterations, error);
                if (whole ? kappa <= widest(precision) : kappa <= 1e2)
                    CHECK(report.status == Status::converged);
                if (report.status == Status::converged)
                    CHECK(error <= 1.01 * kappa * options.tolerance);
                else
                    CHECK((report.status == Status::stagnated || report.status == Status::iteration_limit));
                CHECK(error <= 1.0001); // never worse than saying nothing
                const std::string what = std::string(to_string(precision)) + " " + std::to_string(kappa);
                note("D02", *device, what + " iterations", report.iterations);
                note("D02", *device, what + " forward error", error);
                note("D02", *device, what + " converged", report.status == Status::converged);
            }
        });
    }
}

TEST_CASE("A7: iterations and forward errors of the golden table")
{
    struct Row
    {
        double kappa;
        std::uint32_t iterations;
        double error;
    };
    // fp64 with a tolerance of 1e-12 and fp32 with 1e-6: another random Q, so within 30 % and a factor of 5.
    const Row doubles[] = {{1e2, 115, 7e-12}, {1e4, 645, 4e-10}, {1e6, 3100, 2e-8}};
    const auto device = test_device("cpu:serial");
    for (const Row& row : doubles)
    {
        const SparseMatrix a = graded_spd(row.kappa);
        Random random(12);
        const Vector exact = random_vector(random, kSize), b = product(a, exact);
        SolveOptions options = plain(SolvePrecision::float64, true, 5000);
        options.tolerance = 1e-12;
        const Solution s = solve_checked(device, a, b, options);
        CAPTURE(row.kappa, s.report.reason);
        CHECK(s.report.status == Status::converged);
        CHECK(std::abs(double(s.report.iterations) / row.iterations - 1) < 0.3);
        CHECK(forward_error(s.x, exact) < 5 * row.error);
        note("A7", *device, "double iterations", s.report.iterations);
        note("A7", *device, "double forward error", forward_error(s.x, exact));
    }
}

TEST_CASE("D03: Hilbert matrices are solved as far as residuals tell")
{
    for (const std::uint32_t n : {4u, 6u, 8u, 10u, 12u})
    {
        const SparseMatrix a = hilbert(n);
        const Vector exact = ones(n), b = product(a, exact);
        on_every_device([&](const std::shared_ptr<Device>& device) {
            if (!is_cpu(*device) && n % 4 != 0)
                return;
            for (const SolvePrecision precision : kPrecisions)
                for (const bool one_group : {false, true})
                {
                    SolveOptions options = plain(precision, one_group, 0);
                    options.tolerance = 1e-6;
                    const Solution s = solve_checked(device, a, b, options);
                    CAPTURE(n, to_string(precision), one_group, s.report.reason);
                    CHECK(s.report.status == Status::converged);
                    note("D03", *device, std::to_string(n) + " forward error", forward_error(s.x, exact));
                    options.tolerance = 1e-15; // more than there is: no word but a true one, and it ends
                    const Solution far = solve_checked(device, a, b, options);
                    INFO(far.report.reason);
                    CHECK(far.report.status != Status::indefinite_matrix);
                    CHECK(far.report.relative_residual < 1e-6);
                }
        });
    }
}

TEST_CASE("D15: what falls below the smallest number ends in a word")
{
    const SparseMatrix a = graded_spd(1e14);
    Random random(13);
    const Vector exact = random_vector(random, kSize), b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
            for (const double tolerance : {1e-14, 1e-25, 1e-200})
            {
                const bool whole = device->info().executor == "cpu:serial";
                if (!whole && tolerance != 1e-25)
                    continue;
                SolveOptions options = plain(precision, !is_cpu(*device), whole ? 1000 : 200);
                options.tolerance = tolerance;
                const Solution s = solve_checked(device, a, b, options);
                CAPTURE(to_string(precision), tolerance, s.report.reason);
                CHECK((s.report.status == Status::stagnated || s.report.status == Status::iteration_limit));
                CHECK(s.report.relative_residual < 0.1);
            }
    });
}
