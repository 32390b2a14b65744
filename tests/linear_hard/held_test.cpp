// D17: held rows. Their x keeps every bit, and the others see it.

#include "linear_hard/cases.hpp"

#include <Eigen/Dense>

using namespace taut;
using namespace taut::linear;

namespace {

/// Laplacian of 15 x 15 with 32 held rows, a start of random values.
struct Problem
{
    SparseMatrix a = poisson2d(15); // 225 rows = 3 x 75
    std::vector<std::uint32_t> held;
    Vector b, x0;

    Problem()
    {
        Random random(51);
        held = random.shuffled(a.rows);
        held.resize(32);
        b = random_vector(random, a.rows);
        x0 = random_vector(random, a.rows);
    }

    /// x of the free rows by Cholesky, with the others at x0.
    Vector exact(const Vector& right, const Vector& start) const
    {
        std::vector<bool> is_held(a.rows, false);
        for (const std::uint32_t row : held)
            is_held[row] = true;
        const auto n = Eigen::Index(a.rows);
        Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd r(n);
        for (std::uint32_t i = 0; i < a.rows; ++i)
        {
            r[i] = is_held[i] ? start[i] : right[i];
            if (is_held[i])
                m(i, i) = 1;
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1] && !is_held[i]; ++k)
                if (is_held[a.column[k]])
                    r[i] -= a.value[k] * start[a.column[k]];
                else
                    m(i, a.column[k]) = a.value[k];
        }
        const Eigen::VectorXd x = m.llt().solve(r);
        return Vector(x.data(), x.data() + n);
    }
};

/// Every word of x at the held rows is that of the start.
bool kept(const Problem& p, const Vector& x, const Vector& x0)
{
    for (const std::uint32_t row : p.held)
        if (std::bit_cast<std::uint64_t>(x[row]) != std::bit_cast<std::uint64_t>(x0[row]))
            return false;
    return true;
}

template <typename F>
void for_each_option(const Device& device, const Problem& p, F&& f)
{
    for (const SolvePrecision precision : kPrecisions)
        for (const Format format : {Format::automatic, Format::dense, Format::coo, Format::csr, Format::ell,
                                    Format::sell, Format::bcsr3})
            for (const Preconditioner kind :
                 {Preconditioner::jacobi, Preconditioner::none, Preconditioner::spai0,
                  Preconditioner::block_jacobi, Preconditioner::chebyshev})
            {
                if (kind != Preconditioner::jacobi && format != Format::automatic && format != Format::sell)
                    continue;
                if (!is_cpu(device) && kind == Preconditioner::jacobi && format != Format::automatic &&
                    format != Format::bcsr3)
                    continue;
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.preconditioner = kind;
                options.held = p.held;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                f(options);
            }
}

double close(const SolveOptions& options)
{
    return options.precision == SolvePrecision::float32 ? 1e-3 : 1e-8;
}

} // namespace

TEST_CASE("D17: held rows keep every bit of their start, the others are solved")
{
    const Problem p;
    const Vector exact = p.exact(p.b, p.x0);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, p, [&](const SolveOptions& options) {
            const Solution s = solve_checked(device, p.a, p.b, options, p.x0);
            CAPTURE(words_of(options), s.report.reason);
            CHECK(s.report.status == Status::converged);
            CHECK(kept(p, s.x, p.x0));
            CHECK(forward_error(s.x, exact) < close(options));
        });
    });
}

TEST_CASE("D17: held at zero without a start")
{
    const Problem p;
    const Vector zero(p.a.rows, 0.0), exact = p.exact(p.b, zero);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, p, [&](const SolveOptions& options) {
            const Solution s = solve_checked(device, p.a, p.b, options);
            CAPTURE(words_of(options), s.report.reason);
            CHECK(s.report.status == Status::converged);
            CHECK(kept(p, s.x, zero));
            CHECK(forward_error(s.x, exact) < close(options));
        });
    });
}

TEST_CASE("D17: held values alone make a right-hand side")
{
    const Problem p;
    const Vector zero(p.a.rows, 0.0);
    const Vector exact = p.exact(zero, p.x0);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, p, [&](const SolveOptions& options) {
            const Solution s = solve_checked(device, p.a, zero, options, p.x0);
            CAPTURE(words_of(options), s.report.reason);
            CHECK(s.report.status == Status::converged);
            CHECK(kept(p, s.x, p.x0));
            CHECK(forward_error(s.x, exact) < close(options));
        });
    });
}

TEST_CASE("D17: held rows may be anything, and all may be held")
{
    Problem p;
    // On the free rows positive definite; the held ones have diagonals that would be refused.
    for (std::size_t h = 0; h < p.held.size(); ++h)
        for (std::uint32_t k = p.a.row_start[p.held[h]]; k < p.a.row_start[p.held[h] + 1]; ++k)
            if (p.a.column[k] == p.held[h])
                p.a.value[k] = h % 2 == 0 ? -100 : 0;
    const Vector exact = p.exact(p.b, p.x0);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        for_each_option(*device, p, [&](SolveOptions options) {
            CAPTURE(words_of(options));
            const Solution s = solve_checked(device, p.a, p.b, options, p.x0);
            CHECK(s.report.status == Status::converged);
            CHECK(kept(p, s.x, p.x0));
            CHECK(forward_error(s.x, exact) < close(options));
        });
        SolveOptions all;
        for (std::uint32_t row = 0; row < p.a.rows; ++row)
            all.held.push_back(row);
        const Solution s = solve(device, p.a, p.b, all, p.x0);
        CHECK(s.report.status == Status::zero_right_hand_side);
        CHECK(same_bits(s.x, p.x0));
    });
}
