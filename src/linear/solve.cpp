#include "taut/linear/solve.hpp"

#include "taut/linear/check.hpp"
#include "taut/linear/null_space.hpp"
#include "taut/linear/system_solver.hpp"

#include <algorithm>
#include <chrono>

namespace taut::linear {
namespace {

SolvePrecision resolve(SolvePrecision wanted, const DeviceInfo& device)
{
    if (wanted == SolvePrecision::float64 && !device.limits.float64)
        throw Error(ErrorCode::unsupported, "the device " + device.name +
                                                " has no 64-bit floats: take the precision \"mixed\", which "
                                                "reaches the same residuals without them");
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
        throw Error(ErrorCode::unsupported, "multigrid takes no held rows: take jacobi, block_jacobi or chebyshev");
    for (const std::uint32_t row : options.held)
        if (row >= rows)
            throw Error(ErrorCode::bad_input, "held row " + std::to_string(row) + " is not there: rows count from 0 to " +
                                                  std::to_string(rows - 1));
}

bool all_zero(std::span<const double> v)
{
    return std::all_of(v.begin(), v.end(), [](double entry) { return entry == 0; });
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
                                              std::to_string(x.size()) + " and " + std::to_string(exact.size()));
    std::vector<double> difference(x.begin(), x.end());
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] -= exact[i];
    const double size = norm(exact);
    return size > 0 ? norm(difference) / size : norm(difference);
}

Solution solve(const std::shared_ptr<Device>& device, const SparseMatrix& a, std::span<const double> b,
               const SolveOptions& options, std::span<const double> x0)
{
    const auto start = std::chrono::steady_clock::now();
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
    out.x.assign(a.rows, 0.0);
    if (!x0.empty())
        out.x.assign(x0.begin(), x0.end());

    const NullBasis basis(a, options.null_space, options.null_vectors);
    std::vector<double> right(b.begin(), b.end());
    for (const std::uint32_t row : options.held)
        right[row] = 0;
    const double size = norm(right);
    report.null_part = size > 0 ? basis.project(right) / size : 0;
    if (basis.empty() && a.rows > 0 && maps_constants_to_zero(a))
        report.notes.push_back("A maps constants to zero: x is known up to a constant only");
    if (all_zero(right) && (options.held.empty() || all_zero(out.x)))
    {
        out.x.assign(a.rows, 0.0);
        report.status = Status::zero_right_hand_side;
        report.reason = "b is zero, so x is zero: nothing was iterated";
        return out;
    }
    FormatChoice choice{options.format, "asked for"};
    if (options.format == Format::automatic)
        choice = choose_format(row_statistics(a), device->info().hardware_gpu);
    report.format = choice.format;
    report.format_reason = choice.reason;
    report.setup_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::vector<double> from = out.x;
    out.x = SystemSolver(device, a, right, from, options, report).run();
    if (!basis.empty())
    {
        for (std::size_t i = 0; i < from.size(); ++i)
            out.x[i] -= from[i];
        basis.project(out.x); // what x0 has of the null space stays
        for (std::size_t i = 0; i < from.size(); ++i)
            out.x[i] += from[i];
    }
    return out;
}

} // namespace taut::linear
