// Based on: Ogita, Rump, Oishi. Accurate Sum and Dot Product. SISC 2005 (TwoSum, TwoProductFMA, Dot2).
// Departures: the sum starts at b_i, and products are subtracted.

#include "taut/linear/sparse.hpp"
#include "taut/linear/sparse_algebra.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace taut::linear {
namespace {

void refuse_size(std::size_t have, std::uint32_t want, const char* name, const char* what)
{
    if (have != want)
        throw Error(ErrorCode::bad_input, std::string(name) + " has " + counted(have, "entry", "entries") +
                                              ", but the matrix has " + std::to_string(want) + " " + what);
}

/// sum + low is the sum of all terms but for an error of second order.
struct TwoSum
{
    double sum = 0;
    double low = 0;

    void add(double term)
    {
        const double total = sum + term;
        const double rest = total - sum;
        low += (sum - (total - rest)) + (term - rest);
        sum = total;
    }
    void subtract_product(double a, double x)
    {
        const double product = a * x;
        low -= std::fma(a, x, -product);
        add(-product);
    }
    /// Where a term overflowed `low` is NaN, so that the plain sum says more.
    double value() const { return std::isfinite(sum) ? sum + low : sum; }
};

/// The norm is fraction * 2^exponent: neither the squares nor the quotient of two norms leaves the range.
struct ScaledNorm
{
    double fraction = 0;
    int exponent = 0;
};

/// The largest magnitude; NaN or infinity if there is one (NaN before infinity).
double largest(std::span<const double> values)
{
    double most = 0;
    for (const double v : values)
    {
        if (std::isnan(v))
            return v;
        most = std::abs(v) > most ? std::abs(v) : most;
    }
    return most;
}

ScaledNorm scaled_norm(std::span<const double> values)
{
    const double most = largest(values);
    if (most == 0 || !std::isfinite(most))
        return {most, 0};
    const int exponent = std::ilogb(most);
    // 2^-exponent may itself leave the range: in two steps.
    const double first = std::ldexp(1.0, -exponent / 2),
                 second = std::ldexp(1.0, -exponent - (-exponent / 2));
    double sum = 0;
    for (const double v : values)
    {
        const double scaled = v * first * second;
        sum += scaled * scaled;
    }
    return {std::sqrt(sum), exponent};
}

} // namespace

double norm(std::span<const double> values)
{
    const ScaledNorm n = scaled_norm(values);
    return std::ldexp(n.fraction, n.exponent);
}

void multiply(const SparseMatrix& a, std::span<const double> x, std::span<double> y)
{
    refuse_size(x.size(), a.columns, "x", "columns");
    refuse_size(y.size(), a.rows, "y", "rows");
    for_row_blocks(a.rows, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i)
        {
            double sum = 0;
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
                sum += a.value[k] * x[a.column[k]];
            y[i] = sum;
        }
    });
}

void residual(const SparseMatrix& a, std::span<const double> x, std::span<const double> b,
              std::span<double> r)
{
    refuse_size(x.size(), a.columns, "x", "columns");
    refuse_size(b.size(), a.rows, "b", "rows");
    refuse_size(r.size(), a.rows, "r", "rows");
    for_row_blocks(a.rows, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i)
        {
            TwoSum sum{b[i], 0};
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
                sum.subtract_product(a.value[k], x[a.column[k]]);
            r[i] = sum.value();
        }
    });
}

double relative_residual(const SparseMatrix& a, std::span<const double> x, std::span<const double> b,
                         std::span<const std::uint32_t> held)
{
    std::vector<double> r(a.rows), rest(b.begin(), b.end());
    residual(a, x, b, r);
    for (const std::uint32_t i : held)
    {
        if (i >= a.rows)
            throw Error(ErrorCode::bad_input, "held row " + std::to_string(i) +
                                                  " is outside of a matrix of " + std::to_string(a.rows) +
                                                  " rows (counted from 0)");
        r[i] = rest[i] = 0;
    }
    const ScaledNorm top = scaled_norm(r), bottom = scaled_norm(rest);
    if (bottom.fraction == 0)
        return std::ldexp(top.fraction, top.exponent);
    return std::ldexp(top.fraction / bottom.fraction, top.exponent - bottom.exponent);
}

} // namespace taut::linear
