#pragma once
// Cutting a graph into parts that hang together.

#include "taut/linear/sparse.hpp"

#include <cstdint>
#include <vector>

namespace taut::linear {

inline constexpr std::uint32_t kNoPart = 0xffffffffu;

/// The graph of the 3 x 3 blocks of `pattern`: block rows are its vertices. Parts are numbered from 0 and
/// differ in size by one vertex a level of halving at most; there are `parts` of them, or as many as
/// vertices. Vertices of `left_out` (one flag a block row) are in none (kNoPart). Takes time in proportion to
/// entries times log2(parts). The same for the same input.
std::vector<std::uint32_t> partition(const SparseMatrix& pattern, std::uint32_t parts,
                                     const std::vector<bool>& left_out);

} // namespace taut::linear
