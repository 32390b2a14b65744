#pragma once
// Matrix Market files (Boisvert, Pozo, Remington. The Matrix Market Exchange Formats. NISTIR 5935, 1996):
// coordinate and array; real, integer and pattern; general, symmetric and skew-symmetric.

#include "taut/linear/sparse.hpp"

#include <string>
#include <string_view>

namespace taut::linear {

struct MatrixFile
{
    SparseMatrix matrix;
    BuildNotes notes;
    bool stored_symmetric = false; ///< one triangle was stored
    std::string comment;           ///< lines that begin with %, without the %
};

/// Symmetric files are expanded; pattern entries are 1; zeros of an array are left out. `notes` count in the
/// expanded matrix. Comments and blank lines may stand anywhere below the banner. Values below the range of
/// double are 0. Nothing is allocated for counts that the file is too short for. Throws Error{io} for a file
/// that cannot be read and Error{bad_input}, naming file and line, for everything else: banner, field or
/// symmetry that is not supported (complex and hermitian are refused in words), counts that lie, indices out
/// of range (they count from 1), entries above the diagonal of a symmetric file or on that of a
/// skew-symmetric one, numbers that do not parse or are not finite, text behind an entry or behind the last
/// one, and matrices of which nearly all rows would be empty. Error{limit} where the expanded matrix has
/// 2^32 - 1 entries or more.
MatrixFile read_matrix_market(const std::string& path);
/// The same from text; `name` stands for the file in messages.
MatrixFile parse_matrix_market(std::string_view text, const std::string& name);

/// An n x 1 array (or coordinate) file as a vector of length n. A 1 x n one is refused.
std::vector<double> read_vector(const std::string& path);

/// "array real general", 17 significant digits, written to a temporary name and renamed. Throws Error{io}.
void write_vector(const std::string& path, std::span<const double> values, std::string_view comment = {});
/// "coordinate real general", the same way.
void write_matrix_market(const std::string& path, const SparseMatrix&, std::string_view comment = {});

} // namespace taut::linear
