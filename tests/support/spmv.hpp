#pragma once
// Random rows and the fp64 reference of products with them, for the conformance tests of the kernels spmv_*.
// Every such kernel has the variants "", "dot", "residual" and "residual_pairs" (device_formats.hpp).

#include "support/expect.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace taut::conformance {

/// Compressed rows with values that Real holds exactly, and vectors: x and b as pairs (high, low).
template <typename Real>
struct Rows
{
    std::uint32_t count = 0;
    std::vector<std::uint32_t> start = {0}, column;
    std::vector<Real> values, low;           ///< low words, below half a last digit of the value
    std::vector<Real> x, x_low, b, b_low, y; ///< y: what is in the result before

    std::uint32_t length(std::uint32_t row) const { return start[row + 1] - start[row]; }
};

/// Lengths row by row; columns are distinct and ascend, so a length is cut to the number of rows.
template <typename Real>
Rows<Real> random_rows(Random& random, const std::vector<std::uint32_t>& lengths)
{
    Rows<Real> rows;
    rows.count = static_cast<std::uint32_t>(lengths.size());
    const double tiny = std::numeric_limits<Real>::epsilon() / 4;
    const auto low_of = [&](Real high) { return static_cast<Real>(high * random.uniform(-tiny, tiny)); };
    for (const std::uint32_t length : lengths)
    {
        std::set<std::uint32_t> columns;
        while (columns.size() < std::min(length, rows.count))
            columns.insert(random.below(rows.count));
        rows.column.insert(rows.column.end(), columns.begin(), columns.end());
        rows.start.push_back(static_cast<std::uint32_t>(rows.column.size()));
    }
    for (std::size_t k = 0; k < rows.column.size(); ++k)
    {
        rows.values.push_back(random.uniform<Real>(-2, 2));
        rows.low.push_back(low_of(rows.values.back()));
    }
    for (std::uint32_t i = 0; i < rows.count; ++i)
    {
        rows.x.push_back(random.uniform<Real>(-1, 1));
        rows.x_low.push_back(low_of(rows.x.back()));
        rows.y.push_back(random.uniform<Real>(-1, 1));
    }
    return rows;
}

/// A row sum and the size of its terms.
struct RowSum
{
    long double value = 0, scale = 0;
};

template <typename Real>
RowSum row_sum(const Rows<Real>& rows, std::uint32_t row, bool pairs, bool low)
{
    using Wide = long double;
    RowSum sum;
    for (std::uint32_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
    {
        const Wide value = Wide(rows.values[k]) + (pairs && low ? Wide(rows.low[k]) : Wide(0));
        const std::uint32_t c = rows.column[k];
        const Wide term = value * (Wide(rows.x[c]) + (pairs ? Wide(rows.x_low[c]) : Wide(0)));
        sum.value += term;
        sum.scale += std::abs(term);
    }
    return sum;
}

/// b = A x but for `share` of it, as pairs: what a residual cancels to.
template <typename Real>
void plant_right_hand_side(Rows<Real>& rows, Random& random, double share)
{
    for (std::uint32_t i = 0; i < rows.count; ++i)
    {
        const long double b = row_sum(rows, i, true, true).value * (1 + random.uniform(-share, share));
        rows.b.push_back(static_cast<Real>(b));
        rows.b_low.push_back(static_cast<Real>(b - static_cast<long double>(rows.b.back())));
    }
}

template <typename Real>
std::vector<Real> interleaved(const std::vector<Real>& high, const std::vector<Real>& low)
{
    std::vector<Real> pairs;
    for (std::size_t i = 0; i < high.size(); ++i)
        pairs.insert(pairs.end(), {high[i], low[i]});
    return pairs;
}

/// values[slots[k]] = entry k, the rest `fill`.
template <typename Real>
std::vector<Real> placed(const std::vector<Real>& entries, const std::vector<std::uint32_t>& slots,
                         std::size_t count, Real fill = 0)
{
    std::vector<Real> values(count, fill);
    for (std::size_t k = 0; k < entries.size(); ++k)
        values[slots[k]] = entries[k];
    return values;
}

/// How rows are shared: `chunk` a group, a multiple of the lanes (src/linear/grid.hpp).
struct Grid
{
    std::uint32_t count = 0, groups = 1, chunk = 0;
};

inline Grid grid_of(std::uint32_t count, std::uint32_t groups)
{
    const std::uint32_t lanes = TAUT_LINEAR_GROUP;
    return {count, groups, ((count + groups - 1) / groups + lanes - 1) / lanes * lanes};
}

/// Which rows a kernel writes; of the others y stays.
using Writes = std::function<bool(std::uint32_t row)>;

/// Vectors in and out for one variant; a test adds tables and launches. `slots` place the values among
/// `stored`. `order`: the row at each place, where groups share places; empty: rows are their own places.
template <typename Real>
Case product_case(const Rows<Real>& rows, std::string_view variant, bool low, const Grid& grid,
                  const std::vector<std::uint32_t>& slots, std::size_t stored, const Writes& writes = {},
                  const std::vector<std::uint32_t>& order = {})
{
    const bool pairs = variant.ends_with("pairs"), dot = variant.ends_with("dot");
    const bool residual = variant.find("residual") != variant.npos;
    const double eps = std::numeric_limits<Real>::epsilon();
    Case c;
    c.precision = precision_of<Real>();
    c.in["values"] = bytes_of(placed(rows.values, slots, stored));
    // Without low words the kernel may not read them.
    c.in["low"] = bytes_of(low ? placed(rows.low, slots, stored) : std::vector<Real>(stored, Real(1e3)));
    c.in["x"] = bytes_of(pairs ? interleaved(rows.x, rows.x_low) : rows.x);
    c.in["b"] = bytes_of(pairs ? interleaved(rows.b, rows.b_low) : rows.b);
    c.in["y"] = bytes_of(rows.y);
    c.in["partials"] = bytes_of(std::vector<Real>(grid.groups, Real(7)));
    std::vector<double> sums(grid.groups, 0), scales(grid.groups, 0);
    Field& y = c.expected["y"];
    for (std::uint32_t i = 0; i < rows.count; ++i)
    {
        const RowSum sum = row_sum(rows, i, pairs, low);
        const long double b = pairs ? static_cast<long double>(rows.b[i]) + rows.b_low[i] : rows.b[i];
        const auto value = static_cast<double>(residual ? b - sum.value : sum.value);
        double scale = static_cast<double>(sum.scale + (residual ? std::abs(b) : 0));
        if (pairs) // one rounding of the result, and the terms in two words (the reference itself has 64
                   // bits)
            scale = std::abs(value) + (sizeof(Real) == 4 ? eps : 0x1p-10) * scale;
        if (!writes || writes(i))
            y.add(value, scale);
        else
            y.add(static_cast<double>(rows.y[i]), 0);
    }
    for (std::uint32_t place = 0; place < rows.count; ++place)
    {
        const std::uint32_t i = order.empty() ? place : order[place];
        const double x = static_cast<double>(rows.x[i]), row = y.value[i];
        sums[place / grid.chunk] += x * row;
        scales[place / grid.chunk] += std::abs(x) * std::max(y.scale[i], std::abs(row));
    }
    for (std::uint32_t g = 0; dot && g < grid.groups; ++g)
        c.expected["partials"].add(sums[g], scales[g]);
    return c;
}

} // namespace taut::conformance
