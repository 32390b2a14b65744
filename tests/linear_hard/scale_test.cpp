// D10, D11: numbers far from one. Powers of two change no digit; nothing is silently answered with zero.

#include "linear_hard/cases.hpp"

using namespace taut;
using namespace taut::linear;

namespace {

struct Problem
{
    SparseMatrix a = poisson2d(13);
    Vector exact, b;

    Problem()
    {
        Random random(31);
        for (std::uint32_t i = 0; i < a.rows; ++i) // not all alike, so that the scaling has something to do
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
                if (a.column[k] == i)
                    a.value[k] *= random.uniform(1, 3);
        exact = random_vector(random, a.rows);
        b = product(a, exact);
    }
};

SolveOptions options_for(SolvePrecision precision, Format format)
{
    SolveOptions options;
    options.format = format;
    options.precision = precision;
    options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
    options.keep_history = true;
    return options;
}

/// Calls f(options) for the precisions and, on the CPU, all formats (elsewhere two).
template <typename F>
void for_each_option(const Device& device, F&& f)
{
    for (const SolvePrecision precision : kPrecisions)
        for (const Format format :
             {Format::automatic, Format::sell, Format::dense, Format::coo, Format::csr, Format::ell})
            if (is_cpu(device) || format == Format::automatic || format == Format::sell)
                f(options_for(precision, format));
}

} // namespace

TEST_CASE("D10: scaled by powers of two the answer has the same digits")
{
    const Problem p;
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, [&](const SolveOptions& options) {
            const Solution plain = solve_checked(device, p.a, p.b, options);
            CHECK(plain.report.status == Status::converged);
            for (const int exponent : {100, -100, 1})
                for (const int which : {0, 1, 2})
                {
                    const int of_a = which != 1 ? exponent : 0, of_b = which != 0 ? exponent : 0;
                    const Solution s = solve_checked(device, scaled(p.a, std::ldexp(1, of_a)),
                                                     scaled(p.b, std::ldexp(1, of_b)), options);
                    CAPTURE(words_of(options), exponent, which, s.report.reason);
                    CHECK(s.report.status == Status::converged);
                    CHECK(s.report.iterations == plain.report.iterations);
                    CHECK(s.report.history == plain.report.history);
                    CHECK(same_bits(s.x, scaled(plain.x, std::ldexp(1, of_b - of_a))));
                }
        });
    });
}

TEST_CASE("D10: a start is scaled too")
{
    const Problem p;
    Random random(32);
    const Vector x0 = random_vector(random, p.a.rows);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for (const SolvePrecision precision : kPrecisions)
        {
            const SolveOptions options = options_for(precision, Format::csr);
            const Solution plain = solve_checked(device, p.a, p.b, options, x0);
            const Solution s = solve_checked(device, scaled(p.a, 0x1p100), scaled(p.b, 0x1p-100), options,
                                             scaled(x0, 0x1p-200));
            CHECK(s.report.iterations == plain.report.iterations);
            CHECK(same_bits(s.x, scaled(plain.x, 0x1p-200)));
        }
    });
}

TEST_CASE("D10: at 1e30, 1e-30 and far beyond what float holds the answer is right")
{
    const Problem p;
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, [&](const SolveOptions& options) {
            for (const double scale : {1e30, 1e-30, 1e140, 1e-140})
                for (const int which : {0, 1, 2})
                {
                    const double of_a = which != 1 ? scale : 1, of_b = which != 0 ? scale : 1;
                    const Solution s = solve(device, scaled(p.a, of_a), scaled(p.b, of_b), options);
                    CAPTURE(words_of(options), scale, which, s.report.reason);
                    CHECK(s.report.status == Status::converged);
                    CHECK(s.report.iterations > 0);
                    const Vector x = scaled(scaled(s.x, of_a), 1 / of_b);
                    CHECK(judged_residual(p.a, x, p.b) <= 1.001 * options.tolerance);
                    CHECK(forward_error(x, p.exact) <
                          (options.precision == SolvePrecision::float32 ? 1e-4 : 1e-9));
                }
        });
    });
}

TEST_CASE("D11: entries near the smallest number act or count as zero")
{
    Problem p;
    // Entries that are tiny beside the others: zero to every answer.
    const SparseMatrix dusty = with_entries(
        p.a, std::vector<Triplet>{{3, 90, 1e-40}, {90, 3, 1e-40}, {5, 77, 1e-310}, {77, 5, 1e-310}});
    const SparseMatrix faint = scaled(p.a, 1e-40), fainter = scaled(p.a, 0x1p-1030);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, [&](const SolveOptions& options) {
            CAPTURE(words_of(options));
            const double close = options.precision == SolvePrecision::float32 ? 1e-4 : 1e-9;
            const Solution s = solve_checked(device, dusty, p.b, options);
            CHECK(s.report.status == Status::converged);
            CHECK(forward_error(s.x, p.exact) < close);
            // Nothing but tiny entries: scaled, so that every digit acts.
            const Solution small = solve_checked(device, faint, scaled(p.b, 1e-40), options);
            CHECK(small.report.status == Status::converged);
            CHECK(forward_error(small.x, p.exact) < close);
            // Denormal in double already: digits are gone from the input, some 9 are left.
            const Solution smaller = solve(device, fainter, scaled(p.b, 0x1p-1030), options);
            CAPTURE(smaller.report.reason);
            CHECK(finite(smaller.x));
            CHECK(forward_error(smaller.x, p.exact) < 1e-3);
        });
    });
}
