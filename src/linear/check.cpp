// Based on: nothing; what conjugate gradients assume, asked of the numbers.
// Departures: definiteness is not decided here but by the curvatures that a solve meets.

#include "taut/linear/check.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>
#include <string>

namespace taut::linear {
namespace {

constexpr const char* kCounted = " (rows and columns are counted from 0)";

[[noreturn]] void refuse(const std::string& sentence) { throw Error(ErrorCode::bad_input, sentence); }

std::string place(std::uint32_t row, std::uint32_t column)
{
    return "a(" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

std::string entry(std::uint32_t row, std::uint32_t column, double value)
{
    return place(row, column) + " = " + shown(value);
}

void check_row_starts(const SparseMatrix& a)
{
    const std::uint64_t starts = a.row_start.size();
    if (starts != std::uint64_t{a.rows} + 1)
        refuse("row_start has " + std::to_string(starts) + " entries, but a matrix of " +
               std::to_string(a.rows) + " rows has " + std::to_string(std::uint64_t{a.rows} + 1));
    if (a.row_start.front() != 0)
        refuse("row_start begins with " + std::to_string(a.row_start.front()) + " instead of 0");
    for (std::uint32_t i = 0; i < a.rows; ++i)
        if (a.row_start[i + 1] < a.row_start[i])
            refuse("row " + std::to_string(i) + " (from 0) begins at entry " +
                   std::to_string(a.row_start[i]) + " and ends before entry " +
                   std::to_string(a.row_start[i + 1]) + ": row_start must not fall");
    if (a.row_start.back() != a.column.size() || a.column.size() != a.value.size())
        refuse("row_start ends at " + std::to_string(a.row_start.back()) + ", and there are " +
               std::to_string(a.column.size()) + " columns and " + std::to_string(a.value.size()) +
               " values of entries: the three must be equal");
}

void check_sizes(const SparseMatrix& a, std::span<const double> b, std::span<const double> x0,
                 std::span<const std::uint32_t> held)
{
    if (a.rows != a.columns)
        refuse("the matrix is " + std::to_string(a.rows) + " x " + std::to_string(a.columns) +
               ": a system to solve has as many rows as columns");
    if (b.size() != a.rows)
        refuse("b has " + counted(b.size(), "entry", "entries") + ", but the matrix has " +
               counted(a.rows, "row", "rows") + ": they must be equal");
    if (!x0.empty() && x0.size() != a.rows)
        refuse("x0 has " + counted(x0.size(), "entry", "entries") + ", but the matrix has " +
               counted(a.columns, "column", "columns") + ": give as many, or none to start at zero");
    for (const std::uint32_t row : held)
        if (row >= a.rows)
            refuse("held row " + std::to_string(row) + " is not there: the matrix has " +
                   counted(a.rows, "row", "rows") + ", counted from 0");
}

void check_finite(std::span<const double> values, const char* name, const std::vector<bool>& ignored)
{
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]) && !(i < ignored.size() && ignored[i]))
            refuse(std::string(name) + "(" + std::to_string(i) + ") = " + shown(values[i]) +
                   " is not finite (entries are counted from 0)");
}

void check_finite(const SparseMatrix& a)
{
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            if (!std::isfinite(a.value[k]))
                refuse(entry(i, a.column[k], a.value[k]) + " is not finite" + kCounted);
}

struct Row
{
    double diagonal = 0;
    bool stored = false; ///< the diagonal
    bool zero = true;    ///< every entry
};

Row row_of(const SparseMatrix& a, std::uint32_t i)
{
    Row row;
    for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
    {
        row.zero = row.zero && a.value[k] == 0;
        if (a.column[k] != i)
            continue;
        row.stored = true;
        row.diagonal = a.value[k];
    }
    return row;
}

void check_zero_diagonal(std::uint32_t i, const Row& row, double b)
{
    if (!row.zero)
        refuse((row.stored ? place(i, i) + " is 0" : place(i, i) + " is not stored, so it is 0,") +
               " while row " + std::to_string(i) + " has other entries" + kCounted +
               ": the diagonal of a positive definite matrix is positive");
    if (b != 0)
        refuse("row " + std::to_string(i) + " of the matrix is zero, but b(" + std::to_string(i) +
               ") = " + shown(b) + " is not" + kCounted + ": no x solves that; b must be 0 there");
}

/// sqrt(a_ii), the scale by which a difference in row i is judged; 0 for rows that are zero.
std::vector<double> check_diagonal(const SparseMatrix& a, std::span<const double> b,
                                   const std::vector<bool>& held)
{
    std::vector<double> scale(a.rows);
    std::uint32_t negative = 0, first = 0;
    double first_value = 0;
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        const Row row = row_of(a, i);
        scale[i] = std::sqrt(std::abs(row.diagonal));
        if (held[i])
            continue;
        if (row.diagonal == 0)
            check_zero_diagonal(i, row, b[i]);
        if (row.diagonal < 0 && negative++ == 0)
        {
            first = i;
            first_value = row.diagonal;
        }
    }
    if (negative > 0)
        refuse(entry(first, first, first_value) + " is negative" + kCounted + ", " +
               (negative == 1 ? "the only negative one"
                              : "the first of " + std::to_string(negative) + " negative ones") +
               " among " + counted(a.rows, "diagonal entry", "diagonal entries") + ": " +
               (negative == a.rows ? "if the matrix is negative definite, solve -A x = -b"
                                   : "a positive definite matrix has none"));
    return scale;
}

/// Compares every entry with its mirror, each pair once, without a transpose: as row i goes up, the entries
/// (j, i) that it asks for ascend in every row j, so a cursor a row suffices.
class SymmetryCheck
{
public:
    SymmetryCheck(const SparseMatrix& a, const std::vector<double>& scale, const std::vector<bool>& held)
        : a_(a),
          scale_(scale),
          held_(held),
          cursor_(a.row_start.begin(), a.row_start.end() - 1)
    {
        for (std::uint32_t i = 0; i < a.rows; ++i)
        {
            pass_lone(i, i); // entries left of the diagonal that no row above had
            for (std::uint32_t k = cursor_[i]; k < a.row_start[i + 1]; ++k)
                if (a.column[k] > i)
                    pair(i, a.column[k], a.value[k]);
        }
    }

    /// Throws when the worst difference is above the limit.
    void judge(double limit) const
    {
        if (!(worst_ > limit))
            return;
        const std::string mirror = mirror_stored_ ? entry(column_, row_, mirror_value_)
                                                  : place(column_, row_) + " is not stored, so it is 0";
        refuse("the matrix is not symmetric: " + entry(row_, column_, value_) + ", but " + mirror + kCounted +
               ", a difference of " + shown(worst_, 3) + " of sqrt(" + place(row_, row_) + " " +
               place(column_, column_) + ") where at most " + shown(limit, 3) +
               " passes as rounding; conjugate gradients need a symmetric matrix");
    }

private:
    /// Entries (j, c) of row j with c < below that the cursor has not met have no mirror.
    void pass_lone(std::uint32_t j, std::uint32_t below)
    {
        for (std::uint32_t& k = cursor_[j]; k < a_.row_start[j + 1] && a_.column[k] < below; ++k)
            compare(j, a_.column[k], a_.value[k], 0, false);
    }

    void pair(std::uint32_t i, std::uint32_t j, double value)
    {
        pass_lone(j, i);
        std::uint32_t& k = cursor_[j];
        const bool stored = k < a_.row_start[j + 1] && a_.column[k] == i;
        compare(i, j, value, stored ? a_.value[k] : 0, stored);
        k += stored ? 1 : 0;
    }

    void compare(std::uint32_t i, std::uint32_t j, double value, double mirror, bool stored)
    {
        if (value == mirror || held_[i] || held_[j]) // of held rows only the columns act, and on b alone
            return;
        const double scale = scale_[i] * scale_[j];
        const double difference = std::abs(value / 2 - mirror / 2) / scale * 2; // halves: no overflow
        if (!(difference > worst_))
            return;
        worst_ = difference;
        row_ = i;
        column_ = j;
        value_ = value;
        mirror_value_ = mirror;
        mirror_stored_ = stored;
    }

    const SparseMatrix& a_;
    const std::vector<double>& scale_;
    const std::vector<bool>& held_;
    std::vector<std::uint32_t> cursor_;
    double worst_ = 0, value_ = 0, mirror_value_ = 0;
    std::uint32_t row_ = 0, column_ = 0;
    bool mirror_stored_ = false;
};

/// |1.b| / (|1| |b|)
double constant_share(std::span<const double> b)
{
    const double size = norm(b);
    if (size == 0)
        return 0;
    double sum = 0;
    for (const double v : b)
        sum += v / size;
    return std::abs(sum) / std::sqrt(double(b.size()));
}

void check_consistency(const SparseMatrix& a, std::span<const double> b, double limit)
{
    const double share = constant_share(b);
    if (share <= limit || !maps_constants_to_zero(a))
        return;
    refuse("every row of the matrix sums to zero, so it maps constants to zero, but b is not orthogonal to "
           "them: |1.b| / (|1| |b|) = " +
           shown(share, 3) + " where at most " + shown(limit, 3) +
           " passes as rounding; no x solves that: take the mean out of b, or take constants as null space "
           "(null_space: constants)");
}

} // namespace

void check_structure(const SparseMatrix& a)
{
    check_row_starts(a);
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            if (a.column[k] >= a.columns)
                refuse("entry " + std::to_string(k) + " in row " + std::to_string(i) + " is in column " +
                       std::to_string(a.column[k]) + ", but the matrix has " + std::to_string(a.columns) +
                       " columns (entries, rows and columns are counted from 0)");
            if (k > a.row_start[i] && a.column[k] <= a.column[k - 1])
                refuse("entry " + std::to_string(k) + " in row " + std::to_string(i) + " is in column " +
                       std::to_string(a.column[k]) + " behind one in column " +
                       std::to_string(a.column[k - 1]) +
                       " (all counted from 0): within a row columns ascend and none appears twice, as "
                       "from_triplets makes them");
        }
}

void check_system(const SparseMatrix& a, std::span<const double> b, std::span<const double> x0,
                  const CheckOptions& options)
{
    check_structure(a);
    check_sizes(a, b, x0, options.held);
    std::vector<bool> held(a.rows, false);
    for (const std::uint32_t row : options.held)
        held[row] = true;
    check_finite(a);
    check_finite(b, "b", held);
    check_finite(x0, "x0", {});
    const std::vector<double> scale = check_diagonal(a, b, held);
    SymmetryCheck(a, scale, held).judge(options.asymmetry);
    if (!options.project_constants && options.held.empty())
        check_consistency(a, b, options.consistency);
}

bool maps_constants_to_zero(const SparseMatrix& a)
{
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        double sum = 0, size = 0;
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            sum += a.value[k];
            size += std::abs(a.value[k]);
        }
        if (!(std::abs(sum) <= 1e-12 * size) || std::isinf(size))
            return false;
    }
    return a.rows > 0;
}

void require_float64(const DeviceInfo& device)
{
    if (!device.limits.float64)
        throw Error(ErrorCode::unsupported,
                    device.selector + " has no 64-bit floats: take the precision float, or mixed, which "
                                      "reaches the residuals of double without them");
}

} // namespace taut::linear
