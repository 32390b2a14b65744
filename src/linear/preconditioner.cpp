// Based on:
//   Broeker, Grote. Sparse approximate inverse smoothers for geometric and algebraic multigrid. 2002.
//   (SPAI-0)
//   Higham. Accuracy and Stability of Numerical Algorithms, 2nd ed. 2002, 10.1. (Cholesky of a scaled matrix)
// Departures: rows and columns of held unknowns are left out of every sum, as if the system were written for
//   the others only; a block that is nearly singular for the rounding it will meet gets a small shift.

#include "taut/linear/preconditioner.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace taut::linear {
namespace {

constexpr std::array kPreconditioners = {Preconditioner::none,         Preconditioner::jacobi,
                                         Preconditioner::block_jacobi, Preconditioner::chebyshev,
                                         Preconditioner::multigrid,    Preconditioner::spai0};

/// 1 for each row of `held`.
std::vector<char> marks(const SparseMatrix& a, std::span<const std::uint32_t> held)
{
    const std::uint32_t rows = a.rows;
    std::vector<char> is_held(std::max(rows, a.columns), 0);
    for (const std::uint32_t row : held)
    {
        if (row >= rows)
            throw Error(ErrorCode::bad_input, "held row " + std::to_string(row) +
                                                  " is outside of a matrix of " + std::to_string(rows) +
                                                  " rows (counted from 0)");
        is_held[row] = 1;
    }
    return is_held;
}

struct DiagonalEntry
{
    double diagonal = 0;
    double largest = 0; ///< magnitude over the entries that are not of held columns
};

DiagonalEntry look_at(const SparseMatrix& a, std::uint32_t row, const std::vector<char>& is_held)
{
    DiagonalEntry found;
    for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
    {
        const std::uint32_t column = a.column[k];
        if (column == row)
            found.diagonal = a.value[k];
        if (!is_held[column])
            found.largest = std::max(found.largest, std::abs(a.value[k]));
    }
    return found;
}

/// What 1 / d may be: a smaller d would give infinity, which no later scaling could bring back.
double inverse_of(double d) { return std::min(1 / d, std::numeric_limits<double>::max()); }

void refuse_diagonal(std::uint32_t row, double diagonal)
{
    if (diagonal > 0 && std::isfinite(diagonal))
        return;
    throw Error(ErrorCode::bad_input, "row " + std::to_string(row) + " has " + shown(diagonal) +
                                          " on its diagonal (counted from 0): a preconditioner that "
                                          "divides by the diagonal needs it positive");
}

/// One value a row: 0 where it is held, 1 where it is zero, else of(row, what it holds, marks of held rows).
template <typename Of>
std::vector<double> diagonal_inverse(const SparseMatrix& a, std::span<const std::uint32_t> held, Of of)
{
    const std::vector<char> is_held = marks(a, held);
    std::vector<double> inverse(a.rows, 0);
    for (std::uint32_t row = 0; row < a.rows; ++row)
    {
        if (is_held[row])
            continue;
        const DiagonalEntry found = look_at(a, row, is_held);
        if (found.largest != 0)
            refuse_diagonal(row, found.diagonal);
        inverse[row] = found.largest == 0 ? 1 : of(row, found, is_held);
    }
    return inverse;
}

/// A symmetric 3 x 3 block: xx xy xz yy yz zz.
using Block = std::array<double, 6>;
constexpr std::array kDiagonal = {0, 3, 5};

/// The block on the diagonal at rows 3 * at and on, with 1 on the diagonal of held and of zero rows. The mean
/// of mirrored entries is taken, since only a symmetric preconditioner serves.
Block block_of(const SparseMatrix& a, std::uint32_t at, const std::vector<char>& is_held)
{
    static constexpr int kPlace[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    Block block{};
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        const std::uint32_t row = 3 * at + i;
        double& diagonal = block[kDiagonal[i]];
        if (is_held[row] || look_at(a, row, is_held).largest == 0)
        {
            diagonal = 1;
            continue;
        }
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
        {
            const std::uint32_t column = a.column[k];
            if (column / 3 == at && !is_held[column])
                block[kPlace[i][column % 3]] += column == row ? a.value[k] : 0.5 * a.value[k];
        }
    }
    return block;
}

/// Pivots and factors of L D L^T for a block whose diagonal is `diagonal` throughout.
struct Factors
{
    double pivot1, pivot2; // the first is `diagonal`
    double l10, l20, l21;  // of the inverse of L

    Factors(const Block& s, double diagonal)
    {
        const double f10 = s[1] / diagonal, f20 = s[2] / diagonal;
        pivot1 = diagonal - f10 * s[1];
        const double rest = s[4] - f20 * s[1];
        const double f21 = rest / pivot1;
        pivot2 = diagonal - f20 * s[2] - f21 * rest;
        l10 = -f10;
        l21 = -f21;
        l20 = f10 * f21 - f20;
    }
};

/// The inverse as a sum of three squares: positive definite whatever rounding did to the factors.
Block inverse_of(const Block& block, double rounding, std::uint32_t at)
{
    Block s = block;
    std::array<double, 3> root{};
    for (int i = 0; i < 3; ++i)
        root[i] = 1 / std::sqrt(block[kDiagonal[i]]);
    s[1] *= root[0] * root[1];
    s[2] *= root[0] * root[2];
    s[4] *= root[1] * root[2];
    Factors f(s, 1);
    if (!(f.pivot1 > 0x1p-50 && f.pivot2 > 0x1p-50))
        throw Error(ErrorCode::bad_input,
                    "the 3 x 3 block on the diagonal at block row " + std::to_string(at) + " (rows " +
                        std::to_string(3 * at) + " to " + std::to_string(3 * at + 2) +
                        ", counted from 0) is not positive definite: block_jacobi cannot invert it, "
                        "take jacobi");
    // The smallest eigenvalue is at least 4/9 of the determinant, because the three add up to 3. Below some
    // tens of rounding units the rounded inverse, or r.z with it, might come out negative.
    double diagonal = 1;
    if (4.0 / 9.0 * f.pivot1 * f.pivot2 < 64 * rounding)
    {
        diagonal += 64 * rounding;
        f = Factors(s, diagonal);
    }
    const double d0 = 1 / diagonal, d1 = 1 / f.pivot1, d2 = 1 / f.pivot2;
    return {root[0] * root[0] * (d0 + f.l10 * f.l10 * d1 + f.l20 * f.l20 * d2),
            root[0] * root[1] * (f.l10 * d1 + f.l20 * f.l21 * d2),
            root[0] * root[2] * (f.l20 * d2),
            root[1] * root[1] * (d1 + f.l21 * f.l21 * d2),
            root[1] * root[2] * (f.l21 * d2),
            root[2] * root[2] * d2};
}

} // namespace

std::string_view to_string(Preconditioner kind)
{
    switch (kind)
    {
    case Preconditioner::none: return "none";
    case Preconditioner::jacobi: return "jacobi";
    case Preconditioner::block_jacobi: return "block_jacobi";
    case Preconditioner::chebyshev: return "chebyshev";
    case Preconditioner::multigrid: return "multigrid";
    case Preconditioner::spai0: return "spai0";
    }
    return "unknown";
}

Preconditioner preconditioner_from(std::string_view word)
{
    for (const Preconditioner kind : kPreconditioners)
        if (to_string(kind) == word)
            return kind;
    std::string all;
    for (const Preconditioner kind : kPreconditioners)
        all += (all.empty()                       ? ""
                : kind == kPreconditioners.back() ? " and "
                                                  : ", ") +
               std::string(to_string(kind));
    throw Error(ErrorCode::bad_input, "\"" + std::string(word) + "\" is no preconditioner: there are " + all);
}

std::vector<double> jacobi_inverse(const SparseMatrix& a, std::span<const std::uint32_t> held)
{
    return diagonal_inverse(a, held, [](std::uint32_t, const DiagonalEntry& found, const std::vector<char>&) {
        return inverse_of(found.diagonal);
    });
}

std::vector<double> spai0_inverse(const SparseMatrix& a, std::span<const std::uint32_t> held)
{
    return diagonal_inverse(
        a, held, [&](std::uint32_t row, const DiagonalEntry& found, const std::vector<char>& is_held) {
            double squares = 0; // of entries over the largest: no overflow, and no underflow to zero
            for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
                if (!is_held[a.column[k]])
                    squares += (a.value[k] / found.largest) * (a.value[k] / found.largest);
            return std::min(found.diagonal / found.largest / squares / found.largest,
                            std::numeric_limits<double>::max());
        });
}

std::vector<double> block_jacobi_inverse(const SparseMatrix& a, std::span<const std::uint32_t> held,
                                         double rounding)
{
    if (a.rows % 3 != 0)
        throw Error(ErrorCode::bad_input, "block_jacobi needs a multiple of 3 rows, but there are " +
                                              std::to_string(a.rows) + ": take jacobi");
    const std::vector<char> is_held = marks(a, held);
    std::vector<double> inverse(2 * std::size_t{a.rows});
    for (std::uint32_t at = 0; at < a.rows / 3; ++at)
    {
        const Block block = block_of(a, at, is_held);
        for (std::uint32_t i = 0; i < 3; ++i)
            refuse_diagonal(3 * at + i, block[kDiagonal[i]]);
        Block result = inverse_of(block, rounding, at);
        for (std::uint32_t i = 0; i < 3; ++i)
            if (is_held[3 * at + i])
                result[kDiagonal[i]] = 0; // beside it there is only zero
        std::copy(result.begin(), result.end(), inverse.begin() + 6 * std::ptrdiff_t{at});
    }
    return inverse;
}

} // namespace taut::linear
