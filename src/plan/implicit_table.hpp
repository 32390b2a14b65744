#pragma once
// Internal to src/plan: what implicit Euler solves for, and where the blocks of its matrix lie.

#include "taut/linear/sparse.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// Elements by their corners in plan vertices, `arity` each.
struct Corners
{
    std::uint32_t arity = 2;
    std::vector<std::uint32_t> vertices;
    bool own = true; ///< entries have a place for a vertex's own block, too

    /// Words of an entry: the element, and a place for each corner, or each other one.
    std::uint32_t words() const { return own ? arity + 1 : arity; }
};

/// All that acts, kind by kind, in the order in which the kinds write blocks.
using AllCorners = std::vector<Corners>;

/// Vertices that have mass and an element. All others keep the displacement that they are given.
std::vector<bool> solved_vertices(std::span<const double> inverse_mass, const AllCorners& elements);

/// Three rows a vertex in whole 3 x 3 blocks: the diagonal of every vertex, and with `beside` the blocks of
/// vertices that are solved for and share an element. Values are those of the unit matrix.
linear::SparseMatrix implicit_pattern(const std::vector<bool>& solved, const AllCorners& elements,
                                      bool beside);

/// The tables of kernels/shared/implicit_table.glsl, one a kind, in their order. `slots`: DeviceMatrix::slots
/// of the pattern in bcsr3.
std::vector<std::vector<std::uint32_t>> implicit_tables(const std::vector<bool>& solved,
                                                        const AllCorners& elements,
                                                        const linear::SparseMatrix& pattern,
                                                        std::span<const std::uint32_t> slots);

/// Vertices of the parts that elements hold together and that no held vertex is in, part by part.
struct FreeParts
{
    std::vector<std::uint32_t> start = {0}; ///< parts + 1
    std::vector<std::uint32_t> member;
};
FreeParts free_parts(std::span<const double> inverse_mass, const AllCorners& elements);

/// Most loop trips of a lane that takes every 128th vertex of a chunk and all the entries of each; and of
/// kernels with an invocation a vertex. `words`: of an entry.
std::uint64_t implicit_trips(std::span<const std::uint32_t> table, std::uint32_t vertices,
                             std::uint32_t words, std::uint32_t chunk);

} // namespace taut
