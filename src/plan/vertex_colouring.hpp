#pragma once
// Groups vertices so that the members of one group share no element: each can then be moved on its own.

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// Elements of several corner counts over one set of vertices.
struct VertexGraph
{
    std::uint32_t vertex_count = 0;
    std::vector<std::vector<std::uint32_t>> neighbours; ///< ascending, each once; of free vertices only

    /// `free` vertices move; others need no colour and conflict with nobody.
    explicit VertexGraph(std::vector<bool> free);
    /// Adds elements of `arity` corners each. Call finish() after the last.
    void add(std::span<const std::uint32_t> corners, std::uint32_t arity);
    void finish();

    std::vector<bool> free;
};

inline constexpr std::uint32_t kNoColour = 0xffffffffu;

struct VertexColours
{
    std::vector<std::uint32_t> colour; ///< by vertex; kNoColour where not free
    std::uint32_t count = 0;
    bool lattice = false; ///< (x + p y) mod count
};

/// Greedy in the order of the vertices, lowest colour first, at most degree + 1 colours; then evened out:
/// vertices move from large classes to small feasible ones. With `columns` > 0 the vertices are a grid, row
/// by row, and if (x + p y) mod m is a colouring with as few colours, that is taken. Deterministic.
VertexColours colour_vertices(const VertexGraph& graph, std::uint32_t columns = 0);

/// For boxes of tetrahedra, whose vertices stand at these numbers of cells: (x + y + z) mod 4 is a colouring
/// for six round a diagonal of each cell, and four colours do for five mirrored by turns. Where neither is
/// one (further springs), or greedy takes fewer, greedy. Deterministic.
VertexColours colour_box(const VertexGraph& graph, std::span<const glm::uvec3> places);

} // namespace taut
