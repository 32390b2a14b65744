// Based on: linear/system_solver.hpp.
//   Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, 5.3. (rows that are held are filtered)
// Departures: the null space is taken out of b and of the change of x once, on the host, not in each
//   iteration: products with A leave its range by rounding only.

#include "taut/linear/solve.hpp"

#include "taut/linear/check.hpp"
#include "taut/linear/null_space.hpp"
#include "taut/linear/system_solver.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/runtime/required.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace taut::linear {
namespace {

using Clock = std::chrono::steady_clock;

/// Of |b|, times the root of n: what a projection leaves below it is rounding.
constexpr double kNothingLeft = 0x1p-50;

SolvePrecision resolve(SolvePrecision wanted, const DeviceInfo& device)
{
    if (wanted == SolvePrecision::float64)
        require_float64(device);
    if (wanted != SolvePrecision::automatic)
        return wanted;
    return device.limits.float64 ? SolvePrecision::float64 : SolvePrecision::mixed;
}

void check_options(const SolveOptions& options, std::uint32_t rows)
{
    if (!(options.tolerance > 0 && options.tolerance < 1))
        throw Error(ErrorCode::bad_input, "the tolerance is a share of |b| and must lie between 0 and 1");
    if (options.chebyshev_degree < 1 || options.chebyshev_degree > 16)
        throw Error(ErrorCode::bad_input, "the degree of the Chebyshev polynomial must be 1 to 16, not " +
                                              std::to_string(options.chebyshev_degree));
    if (options.preconditioner == Preconditioner::multigrid && !options.held.empty())
        throw Error(ErrorCode::unsupported,
                    "multigrid takes no held rows: take jacobi, block_jacobi or chebyshev");
    if (options.null_space != NullSpace::none && !options.held.empty())
        throw Error(ErrorCode::unsupported,
                    "held rows fix what a null space leaves open: give one or the other");
    for (const std::uint32_t row : options.held)
        if (row >= rows)
            throw Error(ErrorCode::bad_input, "held row " + std::to_string(row) +
                                                  " is not there: rows count from 0 to " +
                                                  std::to_string(rows - 1));
}

/// x0 at the rows whose x the system does not move, held ones and those of zeros alone, and 0 elsewhere.
std::vector<double> resting(const SparseMatrix& a, std::span<const double> x0,
                            std::span<const std::uint32_t> held)
{
    std::vector<double> rest(a.rows, 0.0);
    if (x0.empty())
        return rest;
    for (const std::uint32_t row : held)
        rest[row] = x0[row];
    for (std::uint32_t i = 0; i < a.rows; ++i)
        if (std::all_of(a.value.begin() + a.row_start[i], a.value.begin() + a.row_start[i + 1],
                        [](double value) { return value == 0; }))
            rest[i] = x0[i];
    return rest;
}

bool all_zero(std::span<const double> v)
{
    return std::all_of(v.begin(), v.end(), [](double entry) { return entry == 0; });
}

/// What is solved: A y = right from `start`, and x = y + shift.
struct Problem
{
    std::vector<double> right, start, shift;
};

/// What rests (see above) is moved to the right-hand side: so it keeps every bit of its start.
Problem pose(const SparseMatrix& a, std::span<const double> b, std::span<const double> x0,
             std::span<const std::uint32_t> held)
{
    Problem out{{b.begin(), b.end()}, {x0.begin(), x0.end()}, resting(a, x0, held)};
    out.start.resize(a.rows, 0);
    for (std::size_t i = 0; i < out.start.size(); ++i)
        out.start[i] -= out.shift[i];
    if (!all_zero(out.shift))
        residual(a, out.shift, b, out.right);
    for (const std::uint32_t row : held)
        out.right[row] = 0;
    return out;
}

void note_padding(const SparseMatrix& a, SolveReport& report)
{
    std::uint32_t longest = 0;
    for (std::uint32_t row = 0; row < a.rows; ++row)
        longest = std::max(longest, a.row_length(row));
    const std::uint64_t stored = std::uint64_t{longest} * a.rows;
    if (static_cast<double>(stored) > kLargeEllWaste * static_cast<double>(a.nonzeros()))
        report.notes.push_back("format ell pads every row to " + std::to_string(longest) +
                               " entries and stores " + std::to_string(stored) + " for " +
                               std::to_string(a.nonzeros()) + "; sell or csr would store less");
}

void choose(SolveReport& report, const SparseMatrix& a, const SolveOptions& options, const DeviceInfo& device)
{
    report.format = options.format;
    report.format_reason = "asked for";
    if (options.format == Format::ell)
        note_padding(a, report);
    if (options.format != Format::automatic)
        return;
    const FormatChoice choice = choose_format(row_statistics(a), device.hardware_gpu);
    report.format = choice.format;
    report.format_reason = choice.reason;
}

/// Takes out of x what the solve added along the null space (what the start has of it stays), unless rounding
/// then makes the residual too large.
void project_change(const NullBasis& basis, const SparseMatrix& a, const Problem& problem,
                    const SolveOptions& options, std::vector<double>& x, SolveReport& report)
{
    std::vector<double> without(x);
    for (std::size_t i = 0; i < x.size(); ++i)
        without[i] -= problem.start[i];
    basis.project(without);
    for (std::size_t i = 0; i < x.size(); ++i)
        without[i] += problem.start[i];
    const double now = relative_residual(a, without, problem.right, options.held);
    if (report.status == Status::converged && !(now <= options.tolerance))
        return;
    report.relative_residual = now;
    x = std::move(without);
}

std::vector<double> times_power(std::span<const double> values, int power)
{
    std::vector<double> out(values.begin(), values.end());
    for (double& value : out)
        value = std::ldexp(value, power);
    return out;
}

/// A right-hand side whose length is beyond double: the system is solved for a 2^600th of it.
Solution solve_small(const std::shared_ptr<Device>& device, const SparseMatrix& a, std::span<const double> b,
                     const SolveOptions& options, std::span<const double> x0)
{
    constexpr int kPower = 600;
    Solution out = solve(device, a, times_power(b, -kPower), options, times_power(x0, -kPower));
    out.x = times_power(out.x, kPower);
    for (std::size_t i = 0; i < out.x.size(); ++i)
        if (!std::isfinite(out.x[i]))
            throw Error(ErrorCode::bad_input,
                        "x[" + std::to_string(i) + "] (from 0) is beyond double: give b in a larger unit");
    return out;
}

} // namespace

std::uint64_t product_bytes(std::uint64_t matrix_bytes, std::uint32_t rows, Precision precision)
{
    return matrix_bytes + 2ull * rows * real_bytes(precision);
}

double forward_error(std::span<const double> x, std::span<const double> exact)
{
    if (x.size() != exact.size())
        throw Error(ErrorCode::bad_input, "forward_error compares vectors of one length, not " +
                                              std::to_string(x.size()) + " and " +
                                              std::to_string(exact.size()));
    std::vector<double> difference(x.begin(), x.end());
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] -= exact[i];
    const double size = norm(exact);
    return size > 0 ? norm(difference) / size : norm(difference);
}

Solution solve(const std::shared_ptr<Device>& device, const SparseMatrix& a, std::span<const double> b,
               const SolveOptions& options, std::span<const double> x0)
{
    const Clock::time_point begin = Clock::now();
    required(device, "solve()");
    check_options(options, a.rows);
    const CheckOptions checks{.asymmetry = options.asymmetry,
                              .project_constants = options.null_space != NullSpace::none,
                              .held = options.held};
    check_system(a, b, x0, checks);
    Solution out;
    SolveReport& report = out.report;
    report.precision = resolve(options.precision, device->info());
    report.preconditioner = options.preconditioner;
    report.device = device->info().selector;
    report.n = a.rows;
    report.nnz = a.nonzeros();
    const NullBasis basis(a, options.null_space, options.null_vectors);
    if (basis.empty() && options.held.empty() && a.rows > 0 && maps_constants_to_zero(a))
        report.notes.push_back("A maps constants to zero: x is known up to a constant only");
    Problem problem = pose(a, b, x0, options.held);
    const double size = norm(problem.right);
    if (!std::isfinite(size))
        return solve_small(device, a, b, options, x0);
    report.null_part = size > 0 ? basis.project(problem.right) / size : 0;
    if (norm(problem.right) <= kNothingLeft * std::sqrt(a.rows) * size)
        problem.right.assign(a.rows, 0.0);
    if (all_zero(problem.right))
    {
        out.x = problem.shift;
        report.status = Status::zero_right_hand_side;
        report.reason = report.null_part > 0
                            ? "b lies in the null space that is taken out, so x is zero: nothing was iterated"
                        : all_zero(out.x) ? "b is zero, so x is zero: nothing was iterated"
                                          : "b drives nothing, so x stays at its start: nothing was iterated";
        return out;
    }
    choose(report, a, options, device->info());
    report.setup_seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    out.x = SystemSolver(device, a, problem.right, problem.start, options, report).run();
    if (!basis.empty())
        project_change(basis, a, problem, options, out.x, report);
    for (std::size_t i = 0; i < out.x.size(); ++i)
        out.x[i] += problem.shift[i];
    report.residual_of_given_b = relative_residual(a, out.x, b, options.held);
    return out;
}

} // namespace taut::linear
