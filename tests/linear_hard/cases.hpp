#pragma once
// What the hard cases of linear systems share: every executor, a judge that is not the library's, matrices.
//
// TAUT_NOTES=1 prints one line a measured number, "D02 | vulkan | forward error | 1.02e-5"; the table of
// docs/hard-cases.md is made of them.

#include "support/expect.hpp"
#include "support/skip.hpp"
#include "support/data.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/linear/solve.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <span>

namespace taut::linear {

using conformance::bitwise_equal_expected;
using conformance::Random;
using Vector = std::vector<double>;

/// Calls f(device) for each executor of this machine.
template <typename F>
void on_every_device(F&& f)
{
    for (const std::string& selector : test_devices())
    {
        INFO(selector);
        const std::shared_ptr<Device> device = test_device(selector);
        f(device);
        CHECK(device->counters().validation_messages == 0);
    }
}

inline bool is_cpu(const Device& device) { return device.info().executor.starts_with("cpu"); }

/// Iterations where software drivers run, too, of which each takes them milliseconds: a third under
/// TAUT_LINEAR_SHORT (as ctest sets it), enough for what differs between executors to differ.
inline std::uint32_t driver_iterations(std::uint32_t alone)
{
    return environment_has("TAUT_LINEAR_SHORT") ? alone / 3 : alone;
}

inline void note(const std::string& id, const Device& device, const std::string& what, double value)
{
    if (const char* wanted = std::getenv("TAUT_NOTES"); wanted && *wanted)
        std::printf("%s | %s | %s | %.3g\n", id.c_str(), device.info().executor.c_str(), what.c_str(), value);
}

inline std::string words_of(const SolveOptions& options)
{
    return std::string(to_string(options.format)) + " " + std::string(to_string(options.precision)) + " " +
           std::string(to_string(options.preconditioner)) + " tolerance " + std::to_string(options.tolerance);
}

/// A sum of products to some 100 bits: products split exactly, sums kept with their errors in long double.
class LongSum
{
public:
    explicit LongSum(double start) : sum_(start) {}
    void subtract_product(double a, double x)
    {
        const double product = a * x;
        add(-static_cast<long double>(product));
        low_ -= static_cast<long double>(std::fma(a, x, -product));
    }
    long double value() const { return sum_ + low_; }

private:
    void add(long double term)
    {
        const long double total = sum_ + term;
        const long double rest = total - sum_;
        low_ += (sum_ - (total - rest)) + (term - rest);
        sum_ = total;
    }
    long double sum_ = 0, low_ = 0;
};

/// |b - A x| / |b| (|A x| where b = 0) as the test finds it, by no code of the library. Held rows are left
/// out, and b is less what they give to the others.
inline double judged_residual(const SparseMatrix& a, std::span<const double> x, std::span<const double> b,
                              std::span<const std::uint32_t> held = {})
{
    std::vector<bool> skipped(a.rows, false);
    for (const std::uint32_t row : held)
        skipped[row] = true;
    long double rr = 0, bb = 0;
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        if (skipped[i])
            continue;
        LongSum sum(b[i]), right(b[i]);
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            sum.subtract_product(a.value[k], x[a.column[k]]);
            if (skipped[a.column[k]])
                right.subtract_product(a.value[k], x[a.column[k]]);
        }
        rr += sum.value() * sum.value();
        bb += right.value() * right.value();
    }
    return static_cast<double>(bb > 0 ? std::sqrt(rr / bb) : std::sqrt(rr));
}

inline bool finite(std::span<const double> values)
{
    for (const double value : values)
        if (!std::isfinite(value))
            return false;
    return true;
}

/// What every answer must be: finite, with a word of a solve and a reason, a true residual, and `converged`
/// only where it is so. Returns the judge's residual.
inline double check_honest(const SparseMatrix& a, std::span<const double> b, const SolveOptions& options,
                           const Solution& solution)
{
    const SolveReport& report = solution.report;
    INFO(words_of(options) << ": " << to_string(report.status) << ", " << report.reason);
    REQUIRE(solution.x.size() == a.rows);
    CHECK(finite(solution.x));
    CHECK_FALSE(report.reason.empty());
    CHECK(report.status != Status::completed);
    CHECK(report.status != Status::interrupted);
    CHECK(report.status != Status::diverged);
    const double judged = judged_residual(a, solution.x, b, options.held);
    if (report.status == Status::converged)
        CHECK(judged <= options.tolerance);
    if (report.status == Status::zero_right_hand_side)
        CHECK(judged == 0);
    // With a null space or held rows the report's b is the projected one, or less what they give: rounded.
    const bool as_given = options.null_space == NullSpace::none && options.held.empty();
    const double rounding = as_given ? 1e-300 : 1e-15;
    CHECK(report.relative_residual == Approx(judged).epsilon(1e-6).margin(rounding));
    return judged;
}

/// Solves and checks that the answer is honest.
inline Solution solve_checked(const std::shared_ptr<Device>& device, const SparseMatrix& a,
                              std::span<const double> b, const SolveOptions& options = {},
                              std::span<const double> x0 = {})
{
    Solution solution = solve(device, a, b, options, x0);
    check_honest(a, b, options, solution);
    return solution;
}

/// The code that f ends with, if it throws an Error.
template <typename F>
std::optional<ErrorCode> code_of(F&& f)
{
    try
    {
        f();
    }
    catch (const Error& error)
    {
        INFO(error.what());
        CHECK(std::string(error.what()).size() > 20);
        return error.code();
    }
    return {};
}

inline constexpr SolvePrecision kPrecisions[] = {SolvePrecision::float32, SolvePrecision::float64,
                                                 SolvePrecision::mixed};
/// Those that stand for all where each would cost too much.
inline constexpr Format kSparseFormats[] = {Format::coo, Format::csr, Format::ell, Format::sell};

inline Vector product(const SparseMatrix& a, std::span<const double> x)
{
    Vector y(a.rows);
    multiply(a, x, y);
    return y;
}

inline Vector random_vector(Random& random, std::size_t n, double low = -1, double high = 1)
{
    Vector v(n);
    for (double& entry : v)
        entry = random.uniform(low, high);
    return v;
}

inline Vector ones(std::size_t n) { return Vector(n, 1.0); }

inline SparseMatrix scaled(SparseMatrix a, double factor)
{
    for (double& value : a.value)
        value *= factor;
    return a;
}

inline Vector scaled(Vector v, double factor)
{
    for (double& entry : v)
        entry *= factor;
    return v;
}

inline Vector times(std::span<const double> a, std::span<const double> b)
{
    Vector out(a.begin(), a.end());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] *= b[i];
    return out;
}

/// D A D.
inline SparseMatrix congruent(SparseMatrix a, std::span<const double> d)
{
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            a.value[k] = d[i] * a.value[k] * d[a.column[k]];
    return a;
}

/// 1 .. most over n entries in equal ratios.
inline Vector graded(std::size_t n, double most)
{
    Vector d(n);
    for (std::size_t i = 0; i < n; ++i)
        d[i] = std::pow(most, double(i) / double(n - 1));
    return d;
}

/// The path of n nodes with free ends: 1 -1, -1 2 -1, ..., -1 1.
inline SparseMatrix neumann(std::uint32_t n)
{
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        for (const auto& [r, c, v] : {Triplet{i, i, 1}, {i + 1, i + 1, 1}, {i, i + 1, -1}, {i + 1, i, -1}})
            t.push_back({r, c, v});
    return from_triplets(n, n, t);
}

inline SparseMatrix diagonal(std::span<const double> d)
{
    std::vector<Triplet> t;
    for (std::uint32_t i = 0; i < d.size(); ++i)
        t.push_back({i, i, d[i]});
    const auto n = static_cast<std::uint32_t>(d.size());
    return from_triplets(n, n, t);
}

inline SparseMatrix with_entries(const SparseMatrix& a, std::span<const Triplet> more, std::uint32_t rows = 0)
{
    std::vector<Triplet> t = to_triplets(a);
    t.insert(t.end(), more.begin(), more.end());
    rows = std::max(rows, a.rows);
    return from_triplets(rows, rows, t);
}

/// The folder of shared/data/matrices; empty, and said, where it is not there.
inline std::filesystem::path matrix_folder()
{
    const auto folder = data_folder() / "matrices";
    if (std::filesystem::exists(folder))
        return folder;
    TAUT_LEFT_OUT("no folder " << folder << "; set TAUT_DATA to the folder of shared data");
    return {};
}

/// Bits of two vectors are the same.
inline bool same_bits(std::span<const double> a, std::span<const double> b)
{
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i]))
            return false;
    return true;
}

} // namespace taut::linear
