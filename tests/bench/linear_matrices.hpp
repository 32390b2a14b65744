#pragma once
// The matrices of the crossover table.

#include "taut/linear/sparse.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bench {

struct NamedMatrix
{
    std::string name;
    std::function<taut::linear::SparseMatrix()> make; ///< symmetric positive definite
};

/// Bands by size and share of places filled, random matrices by how unlike their rows are, and those that the
/// simulator forms: of implicit Euler, cloth and solid, and of implicit constraints.
std::vector<NamedMatrix> crossover_matrices();

} // namespace bench
