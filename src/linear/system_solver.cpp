// Based on: linear/cg.hpp. Scaling by powers of two changes no digit (Higham. Accuracy and Stability of
//   Numerical Algorithms, 2nd ed. 2002, 27.5).
// Departures: an answer that the device holds for converged and the host's residual does not is solved on,
//   with a smaller tolerance, from where it is.

#include "taut/linear/system_solver.hpp"

#include "taut/linear/device_preconditioner.hpp"
#include "taut/linear/host_sums.hpp"
#include "taut/linear/reals.hpp"
#include "taut/linear/solve_reason.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace taut::linear {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kChunk = 64; ///< iterations of a replay
constexpr int kRounds = 4;           ///< times that a tolerance is made smaller
constexpr int kProductTurns = 5;
constexpr double kFarOff = 0.5;   ///< a residual below this share of the last one's is worth going back for
constexpr double kFarStart = 1e6; ///< |b - A x0| / |b| beyond which a start is no help
constexpr std::uint64_t kSmallEntries = 20000; ///< of a system of one group: more is read faster by many

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Exponent that brings the largest entry to [1, 2): 0 where all are zero.
int vector_exponent(std::span<const double> v)
{
    double largest = 0;
    for (const double entry : v)
        largest = std::max(largest, std::abs(entry));
    return largest > 0 ? -std::ilogb(largest) : 0;
}

} // namespace

SystemSolver::SystemSolver(std::shared_ptr<Device> device, const SparseMatrix& a, std::span<const double> b,
                           std::span<const double> x0, const SolveOptions& options, SolveReport& report)
    : device_(std::move(device)),
      a_(a),
      b_(b),
      x_(x0.begin(), x0.end()),
      options_(options),
      report_(report),
      precision_(report.precision == SolvePrecision::float64 ? Precision::float64 : Precision::float32),
      pairs_(report.precision == SolvePrecision::mixed),
      matrix_exponent_(DeviceMatrix::scale_exponent(a)),
      vector_exponent_(vector_exponent(b))
{
    settings_.tolerance = options.tolerance;
    settings_.iteration_limit = report_limit();
    settings_.patience = std::clamp(a.rows, 500u, 5000u);
}

std::vector<double> SystemSolver::run()
{
    const Clock::time_point start = Clock::now();
    report_.relative_residual = relative_residual(a_, x_, b_, options_.held);
    drop_far_start();
    prepare();
    report_.setup_seconds += seconds_since(start);
    CgOutcome outcome;
    for (int round = 0; round < kRounds; ++round)
    {
        const std::vector<double> from = x_;
        const double before = best_residual_;
        outcome = solve_once();
        if (best_residual_ < before)
            start_ = from;
        if (settle(outcome))
            break;
    }
    if (report_.status != Status::converged && report_.status != Status::iteration_limit)
        go_back();
    report_.reason = reason_of(report_, outcome, options_, beyond_double_);
    report_.ms_per_iteration = report_.iterations > 0 ? report_.seconds * 1e3 / report_.iterations : 0;
    if (options_.measure_product)
        measure_product();
    return std::move(x_);
}

std::uint32_t SystemSolver::report_limit() const
{
    if (options_.max_iterations > 0)
        return options_.max_iterations;
    return std::max(1000u, static_cast<std::uint32_t>(std::min<std::uint64_t>(10ull * a_.rows, 1u << 30)));
}

/// A start that is worse than zero by many digits costs them all; in float it may not even be held.
void SystemSolver::drop_far_start()
{
    if (report_.relative_residual <= kFarStart || !options_.held.empty())
        return; // what is not a number is far, too
    report_.notes.push_back("x0 was dropped: its residual is " + shown(report_.relative_residual, 3) +
                            " |b|, that of zero is 1");
    x_.assign(a_.rows, 0.0);
    report_.relative_residual = 1;
}

bool SystemSolver::small() const
{
    const Preconditioner kind = options_.preconditioner;
    return options_.one_group && options_.format == Format::automatic && a_.rows <= kSmallRows &&
           a_.nonzeros() <= kSmallEntries && kind != Preconditioner::block_jacobi &&
           kind != Preconditioner::chebyshev && kind != Preconditioner::multigrid;
}

void SystemSolver::prepare()
{
    if (small())
    {
        const std::vector<double> inverse =
            scaled_inverse({a_, matrix_exponent_, precision_, options_}, options_.preconditioner);
        batch_ = std::make_unique<SmallBatch>(device_, std::span(&a_, 1), std::span(&matrix_exponent_, 1),
                                              std::span(&inverse, 1), precision_, pairs_);
        report_.one_group = true;
        report_.bytes = matrix_bytes(Format::csr, a_, precision_, pairs_);
        report_.format = Format::csr;
        report_.format_reason = "csr, because " + std::to_string(a_.rows) +
                                " rows are solved by one work group, which reads compressed rows";
        return;
    }
    matrix_ = DeviceMatrix::upload(device_, a_, {report_.format, precision_, pairs_, matrix_exponent_});
    report_.bytes = matrix_->bytes();
    cg_ = std::make_unique<ConjugateGradient>(
        device_, matrix_,
        make_preconditioning(device_, {a_, matrix_exponent_, precision_, options_}, matrix_), pairs_);
    Recorder recorder(device_);
    cg_->record_begin(recorder);
    begin_ = recorder.finish();
    cg_->record_iterations(recorder, kChunk);
    chunk_ = recorder.finish();
}

std::vector<double> SystemSolver::scaled(std::span<const double> v, int exponent) const
{
    std::vector<double> out(v.begin(), v.end());
    for (double& entry : out)
        entry = std::ldexp(entry, exponent);
    const double largest = precision_ == Precision::float64 ? std::numeric_limits<double>::max()
                                                            : std::numeric_limits<float>::max();
    for (const double entry : out)
        if (!(std::abs(entry) <= largest))
            throw Error(ErrorCode::bad_input,
                        "the start x0 is too far from the size of b for the precision " +
                            std::string(to_string(report_.precision)) + ": leave it out or take double");
    return out;
}

CgOutcome SystemSolver::solve_once()
{
    const std::vector<double> b = scaled(b_, vector_exponent_);
    const std::vector<double> x = scaled(x_, vector_exponent_ - matrix_exponent_);
    return batch_ ? solve_small(b, x) : solve_large(b, x);
}

CgOutcome SystemSolver::solve_small(std::span<const double> b, std::span<const double> x)
{
    batch_->set(settings_);
    batch_->start(b, x);
    const Clock::time_point start = Clock::now();
    batch_->run();
    report_.seconds += seconds_since(start);
    CgOutcome outcome = batch_->outcome(0);
    check_curvature(batch_->direction(0), outcome);
    const std::vector<float> history = batch_->history(0);
    const std::uint32_t first = outcome.iterations + 1 - static_cast<std::uint32_t>(history.size());
    watch(history, first);
    append(history, first);
    take(unscaled(batch_->x(0)));
    return outcome;
}

CgOutcome SystemSolver::solve_large(std::span<const double> b, std::span<const double> x)
{
    write_reals(*device_, cg_->b(), pairs_ ? as_pairs(b) : std::vector(b.begin(), b.end()), precision_);
    write_reals(*device_, cg_->x(), pairs_ ? as_pairs(x) : std::vector(x.begin(), x.end()), precision_);
    cg_->set(settings_);
    const Clock::time_point start = Clock::now();
    begin_->replay();
    CgOutcome outcome;
    std::uint32_t told = 0;
    do
    {
        chunk_->replay();
        outcome = cg_->outcome();
        // While it runs, the last entry is written only when the next iteration begins.
        const std::uint32_t upto = outcome.iterations + (outcome.running ? 0 : 1);
        if (upto > told)
        {
            const std::vector<float> part = cg_->history(told, upto - 1);
            watch(part, told);
            append(part, told);
        }
        told = upto;
    } while (outcome.running);
    report_.seconds += seconds_since(start);
    check_curvature(read_reals(*device_, cg_->direction(), a_.rows, precision_), outcome);
    const std::vector<double> base = read(cg_->x());
    const std::vector<double> gained = read_reals(*device_, cg_->gain(), a_.rows, precision_);
    std::vector<double> sum = base;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += gained[i];
    take(unscaled(base));
    take(unscaled(sum));
    return outcome;
}

void SystemSolver::append(const std::vector<float>& part, std::uint32_t first)
{
    if (!options_.keep_history || going_back_)
        return;
    // Taken up again: where it starts is the last entry, formed anew.
    const bool known = first == 0 && !part.empty() && !report_.history.empty();
    report_.history.insert(report_.history.end(), part.begin() + (known ? 1 : 0), part.end());
}

void SystemSolver::watch(const std::vector<float>& part, std::uint32_t first)
{
    for (std::size_t k = 0; k < part.size(); ++k)
        if (part[k] < best_residual_)
        {
            best_residual_ = part[k];
            best_iteration_ = first + static_cast<std::uint32_t>(k);
        }
}

void SystemSolver::go_back()
{
    if (!(best_residual_ < kFarOff * report_.relative_residual) || best_iteration_ == 0)
        return;
    going_back_ = true;
    const double last = report_.relative_residual, seconds = report_.seconds;
    std::vector<double> kept = std::exchange(x_, start_);
    settings_.iteration_limit = best_iteration_;
    solve_once();
    report_.seconds = seconds; // of the iterations that are reported
    if (!(report_.relative_residual < last))
        x_ = std::move(kept);
    else
        report_.notes.push_back("x is that of iteration " + std::to_string(best_iteration_) +
                                ", where the residual was smallest");
    if (report_.relative_residual <= options_.tolerance)
        report_.status = Status::converged;
}

std::vector<double> SystemSolver::read(const BufferPtr& buffer) const
{
    if (!pairs_)
        return read_reals(*device_, buffer, a_.rows, precision_);
    const std::vector<double> words = read_reals(*device_, buffer, 2 * std::size_t{a_.rows}, precision_);
    std::vector<double> values(a_.rows);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = words[2 * i] + words[2 * i + 1];
    return values;
}

std::vector<double> SystemSolver::unscaled(std::vector<double> x)
{
    for (double& entry : x)
    {
        const bool finite = std::isfinite(entry);
        entry = std::ldexp(entry, matrix_exponent_ - vector_exponent_);
        beyond_double_ = beyond_double_ || (finite && !std::isfinite(entry));
    }
    return x;
}

/// Keeps the better of what there is and `candidate`: by the true residual, and not for a whisker unless it
/// decides, since where the iteration ran along a null space a larger x is no better one.
void SystemSolver::take(std::vector<double> candidate)
{
    const double now = relative_residual(a_, candidate, b_, options_.held);
    const bool better = std::isnan(report_.relative_residual) || now < 0.99 * report_.relative_residual;
    const bool enough = now <= options_.tolerance && !(report_.relative_residual <= options_.tolerance);
    if (std::isnan(now) || !(better || enough) || !std::isfinite(norm(candidate)))
        return;
    report_.relative_residual = now;
    x_ = std::move(candidate);
}

/// A matrix whose entries are many decades apart may be definite where it has been rounded to float, with a
/// sum of as many decades, is not: what is said of A has to hold of the one that was given.
void SystemSolver::check_curvature(std::span<const double> direction, CgOutcome& outcome) const
{
    if (outcome.status != Status::indefinite_matrix)
        return;
    std::vector<double> p(direction.begin(), direction.end()), product(a_.rows);
    for (const std::uint32_t row : options_.held)
        p[row] = 0;
    multiply(a_, p, product);
    if (!(dot(p, product) > 0))
        return;
    outcome.status = Status::stagnated;
    outcome.misread = true;
}

/// Says how it ended; false: go on with a smaller tolerance.
bool SystemSolver::settle(const CgOutcome& outcome)
{
    report_.iterations += outcome.iterations;
    report_.replacements += outcome.replacements;
    report_.recursive_residual = outcome.residual;
    report_.status = outcome.status;
    const bool good = report_.relative_residual <= options_.tolerance;
    if (good && outcome.status != Status::zero_right_hand_side)
        report_.status = Status::converged;
    if (!good && outcome.status == Status::converged)
    {
        report_.status = Status::stagnated;
        const double overshoot = report_.relative_residual / options_.tolerance;
        const bool again = overshoot < last_overshoot_ * 0.99 && report_.iterations < report_limit();
        last_overshoot_ = overshoot;
        settings_.tolerance *= 0.5 / std::max(overshoot, 1.0);
        settings_.iteration_limit = report_limit() - std::min(report_limit(), report_.iterations);
        if (again && settings_.tolerance > 1e-18)
            return false;
    }
    return true;
}

void SystemSolver::measure_product()
{
    if (!matrix_)
        return;
    Recorder recorder(device_);
    const Gate always{group_count_for(a_.rows, device_->info()), nullptr, 0};
    BufferPtr y = device_->make_buffer(a_.rows * std::uint64_t{real_bytes(precision_)}, "product y");
    BufferPtr x = device_->make_buffer(a_.rows * std::uint64_t{real_bytes(precision_)}, "product x");
    write_reals(*device_, x, std::vector<double>(a_.rows, 1.0), precision_);
    matrix_->record_product(recorder, always, x, y, Recorder::Binding(nullptr));
    const auto product = recorder.finish();
    double best = std::numeric_limits<double>::max();
    for (int turn = 0; turn < kProductTurns; ++turn)
    {
        const Clock::time_point start = Clock::now();
        product->replay();
        device_->wait();
        best = std::min(best, seconds_since(start));
    }
    report_.spmv_gb_per_s =
        static_cast<double>(product_bytes(matrix_->bytes(), a_.rows, precision_)) / best * 1e-9;
}

} // namespace taut::linear
