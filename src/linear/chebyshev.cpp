// Based on:
//   Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, algorithm 12.1. (the recurrence)
//   Lanczos. An iteration method for the solution of the eigenvalue problem. 1950. (the upper end)
//   Barth, Martin, Wilkinson. Calculation of the eigenvalues of a symmetric tridiagonal matrix by the method
//   of bisection. 1967.
// Departures: Lanczos runs on D^-1/2 A D^-1/2 without making its vectors orthogonal again: copies of an
//   eigenvalue do not move the largest one.
//
// Why the preconditioner is symmetric positive definite. It is q(D^-1 A) D^-1 = D^-1/2 q(S) D^-1/2 with
// S = D^-1/2 A D^-1/2, on the rows that are not held, and q is one polynomial of degree m - 1, the same for
// every r: so it is symmetric, and definite if q > 0 on the spectrum of S. With lo and hi the ends of the
// interval, c their mean and d half of their distance, l q(l) = 1 - T_m((c - l) / d) / T_m(c / d). Within
// [lo, hi] the upper T_m is at most 1 in magnitude and the lower one above 1; in (0, lo) the upper one is
// smaller than the lower one because T_m grows beyond 1. So l q(l) > 0 up to hi. Above hi: with odd m the
// upper T_m is negative, with even m it stays the smaller one up to hi + lo. An upper end that is too low by
// less than lo does no harm. Coefficients are rounded to float: the margin, 1 - 1 / T_m(c / d), is far above
// that at spreads up to 10^4.

#include "taut/linear/preconditioner.hpp"

#include "taut/kernels/chebyshev.hpp"
#include "taut/linear/host_sums.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::linear {
namespace {

constexpr int kLanczosSteps = 15;
constexpr double kLanczosFactor = 1.05; // what 15 steps may lack
constexpr int kMostDegree = 16;
constexpr const char* kChebyshevLabel = "chebyshev";

/// Diagonal and squared off-diagonal entries of a symmetric tridiagonal matrix.
struct Tridiagonal
{
    std::vector<double> diagonal, square;
};

/// Whether all eigenvalues are below `at`: by the signs of the pivots of T - at.
bool all_below(const Tridiagonal& t, double at)
{
    double pivot = -1;
    for (std::size_t k = 0; k < t.diagonal.size(); ++k)
    {
        pivot = t.diagonal[k] - at - (k > 0 ? t.square[k - 1] / pivot : 0);
        if (!(pivot < 0))
            return false;
    }
    return true;
}

double largest_eigenvalue(const Tridiagonal& t)
{
    double low = t.diagonal[0], high = low;
    for (std::size_t k = 0; k < t.diagonal.size(); ++k)
    {
        const double before = k > 0 ? std::sqrt(t.square[k - 1]) : 0;
        const double after = k < t.square.size() ? std::sqrt(t.square[k]) : 0;
        low = std::max(low, t.diagonal[k]);
        high = std::max(high, t.diagonal[k] + before + after);
    }
    for (int turn = 0; turn < 60; ++turn)
    {
        const double middle = 0.5 * (low + high);
        (all_below(t, middle) ? high : low) = middle;
    }
    return high;
}

/// Entries of mixed signs and sizes, the same on every machine; 0 in held rows. Length 1.
std::vector<double> fixed_start(std::span<const double> inverse)
{
    std::vector<double> v(inverse.size(), 0);
    std::uint32_t word = 12345;
    for (std::size_t i = 0; i < v.size(); ++i)
    {
        word = word * 1664525u + 1013904223u;
        const double size = 0.5 + static_cast<double>(word >> 9) * 0x1p-23;
        if (inverse[i] > 0)
            v[i] = (word >> 8) % 2 == 0 ? size : -size;
    }
    const double length = norm(v);
    for (double& entry : v)
        entry = length > 0 ? entry / length : 0;
    return v;
}

/// Largest eigenvalue of D^-1/2 A D^-1/2 as `kLanczosSteps` products show it: from below.
double lanczos(const SparseMatrix& a, std::span<const double> inverse)
{
    const std::size_t n = inverse.size();
    std::vector<double> root(n), v = fixed_start(inverse), before(n, 0), scaled(n), w(n);
    for (std::size_t i = 0; i < n; ++i)
        root[i] = std::sqrt(inverse[i]);
    Tridiagonal t;
    double link = 0;
    for (int step = 0; step < kLanczosSteps; ++step)
    {
        for (std::size_t i = 0; i < n; ++i)
            scaled[i] = root[i] * v[i];
        multiply(a, scaled, w);
        for (std::size_t i = 0; i < n; ++i)
            w[i] = (root[i] > 0 ? root[i] * w[i] : 0) - link * before[i];
        const double alpha = dot(v, w);
        t.diagonal.push_back(alpha);
        for (std::size_t i = 0; i < n; ++i)
            w[i] -= alpha * v[i];
        link = norm(w);
        // What is left is rounding: the space is used up.
        if (step + 1 == kLanczosSteps || !(link > 1e-12 * std::abs(largest_eigenvalue(t))))
            break;
        t.square.push_back(link * link);
        before = v;
        for (std::size_t i = 0; i < n; ++i)
            v[i] = w[i] / link;
    }
    return largest_eigenvalue(t);
}

std::string_view variant_of(int step, bool last)
{
    if (step == 0)
        return last ? "only" : "first";
    if (step == 1)
        return last ? "second_last" : "second";
    return last ? "last" : "";
}

} // namespace

Interval chebyshev_interval(const SparseMatrix& a, std::span<const double> inverse_diagonal, double spread)
{
    if (a.rows != a.columns || inverse_diagonal.size() != a.rows)
        throw Error(ErrorCode::bad_input,
                    "an interval of eigenvalues needs a square matrix and one value a row, but there are " +
                        std::to_string(a.rows) + " rows, " + std::to_string(a.columns) + " columns and " +
                        std::to_string(inverse_diagonal.size()) + " values");
    if (!(spread > 1) || !std::isfinite(spread))
        throw Error(ErrorCode::bad_input,
                    "the spread of the interval of a Chebyshev polynomial must be above 1, not " +
                        shown(spread));
    for (std::size_t i = 0; i < inverse_diagonal.size(); ++i)
        if (!(inverse_diagonal[i] >= 0))
            throw Error(ErrorCode::bad_input, "the inverse of the diagonal is " + shown(inverse_diagonal[i]) +
                                                  " in row " + std::to_string(i) +
                                                  " (counted from 0): it must be positive, or 0 where "
                                                  "a row is held");
    const double bound = gershgorin<std::uint32_t>(a.row_start, a.column, a.value, inverse_diagonal);
    double highest = a.rows > 0 ? std::min(kLanczosFactor * lanczos(a, inverse_diagonal), bound) : 0;
    if (!(highest > 0))
        highest = bound > 0 ? bound : 1; // a zero matrix: any interval serves
    return {highest / spread, highest};
}

Chebyshev::Chebyshev(std::shared_ptr<Device> device, std::shared_ptr<const Operator> op, BufferPtr inverse,
                     Interval interval, int degree)
    : operator_(std::move(op)),
      inverse_(std::move(inverse)),
      interval_(interval),
      degree_(degree)
{
    if (degree < 1 || degree > kMostDegree)
        throw Error(ErrorCode::bad_input,
                    "the degree of a Chebyshev polynomial must be 1 to 16, not " + std::to_string(degree));
    if (!(interval.lowest > 0 && interval.highest > interval.lowest && std::isfinite(interval.highest)))
        throw Error(ErrorCode::bad_input,
                    "a Chebyshev polynomial needs an interval 0 < lowest < highest, not [" +
                        shown(interval.lowest) + ", " + shown(interval.highest) + "]");
    const std::uint64_t bytes = std::uint64_t{operator_->rows()} * real_bytes(operator_->precision());
    if (!inverse_ || inverse_->bytes() < bytes)
        throw Error(ErrorCode::bad_input,
                    "the inverse of the diagonal needs one value a row: " + std::to_string(bytes) + " bytes");
    if (degree > 1)
    {
        other_ = device->make_buffer(bytes, "chebyshev z");
        product_ = device->make_buffer(bytes, "chebyshev product");
    }
}

std::uint64_t Chebyshev::bytes() const
{
    return inverse_->bytes() + (other_ ? other_->bytes() + product_->bytes() : 0);
}

void Chebyshev::record(Recorder& recorder, const Gate& gate, Operator::Binding r, Operator::Binding z,
                       Operator::Binding partials) const
{
    const double middle = 0.5 * (interval_.highest + interval_.lowest);
    const double half = 0.5 * (interval_.highest - interval_.lowest);
    const double sigma = middle / half;
    const Grid grid = make_grid(operator_->rows(), gate.groups);
    double rho = 1 / sigma, momentum = 0, gain = 1 / middle;
    for (int step = 0; step < degree_; ++step)
    {
        // The iterates lie in z and in the other buffer by turns, the last one in z.
        const bool in_z = (degree_ - 1 - step) % 2 == 0;
        const Operator::Binding next = in_z ? z : Operator::Binding(other_);
        const Operator::Binding at = in_z ? Operator::Binding(other_) : z;
        kernels::chebyshev::Bindings<Operator::Binding> bindings = {
            .residual = r, .inverse = inverse_, .z = next};
        if (step > 0)
        {
            operator_->record_product(recorder, gate, at, product_, {});
            const double after = 1 / (2 * sigma - rho);
            momentum = after * rho;
            gain = 2 * after / half;
            rho = after;
            bindings.at = at;
            bindings.product = product_;
        }
        const bool last = step + 1 == degree_ && partials.is_set();
        if (last)
            bindings.partials = partials;
        launch(recorder, gate, {variant_of(step, last), operator_->precision(), kChebyshevLabel}, bindings,
               {grid.count, grid.chunk, gate.groups, static_cast<float>(momentum), static_cast<float>(gain)});
    }
}

} // namespace taut::linear
