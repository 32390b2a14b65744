#pragma once
// Sparse matrices on the host: compressed rows in fp64, from which every device format is packed and against
// which every answer is judged.

#include <cstdint>
#include <span>
#include <vector>

namespace taut::linear {

struct Triplet
{
    std::uint32_t row = 0;    ///< from 0
    std::uint32_t column = 0; ///< from 0
    double value = 0;
};

/// Compressed rows. Within a row columns ascend and none appears twice. Fewer than 2^32 - 1 entries.
struct SparseMatrix
{
    std::uint32_t rows = 0;
    std::uint32_t columns = 0;
    /// rows + 1; row i owns entries row_start[i]..row_start[i+1]-1
    std::vector<std::uint32_t> row_start = {0};
    std::vector<std::uint32_t> column;
    std::vector<double> value;

    std::uint64_t nonzeros() const { return column.size(); }
    std::uint32_t row_length(std::uint32_t row) const { return row_start[row + 1] - row_start[row]; }
};

/// What building a matrix found that is worth a note, but no error.
struct BuildNotes
{
    std::uint64_t duplicates = 0; ///< entries that were added to an earlier one of the same place
    Triplet first_duplicate;
    std::uint64_t explicit_zeros = 0; ///< stored entries of value 0; they stay
};

/// Entries of the same place are summed in the order given. Throws Error{bad_input} naming the first entry
/// that is out of range, Error{limit} for 2^32 - 1 entries or more.
SparseMatrix from_triplets(std::uint32_t rows, std::uint32_t columns, std::span<const Triplet>,
                           BuildNotes* notes = nullptr);

/// Row-major; entries that are exactly 0 are left out. Throws Error{bad_input} unless values are
/// rows*columns.
SparseMatrix from_dense(std::uint32_t rows, std::uint32_t columns, std::span<const double> values);

/// In order of row, then column.
std::vector<Triplet> to_triplets(const SparseMatrix&);

/// y = A x in fp64, each row in order of its columns; rows are shared out among all cores. Sizes must fit
/// (Error{bad_input}).
void multiply(const SparseMatrix&, std::span<const double> x, std::span<double> y);

/// r = b - A x, every entry as if computed in twice the working precision and rounded (Ogita, Rump, Oishi.
/// Accurate Sum and Dot Product. SISC 2005, Dot2): the judge of every solve. On all cores, too.
void residual(const SparseMatrix&, std::span<const double> x, std::span<const double> b, std::span<double> r);

/// |b - A x| / |b| in the 2-norm, safe from overflow; |A x| where b = 0. Rows of `held` are left out.
double relative_residual(const SparseMatrix&, std::span<const double> x, std::span<const double> b,
                         std::span<const std::uint32_t> held = {});

/// 2-norm without overflow or underflow; NaN or infinity if an entry is.
double norm(std::span<const double>);

/// The 7-point Laplacian on n x n x n unknowns with zero values around: 6 on the diagonal, -1 beside it.
SparseMatrix poisson3d(std::uint32_t n);
/// The 5-point Laplacian on n x n unknowns: 4 and -1.
SparseMatrix poisson2d(std::uint32_t n);

} // namespace taut::linear
