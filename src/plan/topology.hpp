#pragma once
// Pure functions over meshes and constraint graphs: edges, hinges, vertex order, colours.

#include "taut/scene/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// An interior or boundary edge with the triangles at it.
struct MeshEdge
{
    std::uint32_t a = 0, b = 0;             ///< a < b
    std::vector<std::uint32_t> triangles;   ///< ascending
};

/// Every edge once, sorted by (a, b).
std::vector<MeshEdge> mesh_edges(const Mesh& mesh);

/// Two triangles that share an edge: wing0 is opposite in the first, wing1 in the second. Along
/// edge0->edge1 the first triangle is wound (edge0, edge1, wing0).
struct Hinge
{
    std::uint32_t edge0 = 0, edge1 = 0, wing0 = 0, wing1 = 0;
};

/// One hinge for each pair of adjacent triangles, in ascending order: an edge with three triangles
/// gives three (case C01). Deterministic.
std::vector<Hinge> mesh_hinges(const Mesh& mesh);

/// Old index of each new vertex: along a space-filling curve (Morton order of the rest positions).
std::vector<std::uint32_t> locality_order(std::span<const glm::dvec3> positions);

/// A constraint as a colouring sees it: the vertices it writes. `stride` vertices each.
struct ConstraintGraph
{
    std::uint32_t vertex_count = 0;
    std::uint32_t stride = 2;
    std::vector<std::uint32_t> vertices; ///< constraint_count * stride
    std::vector<bool> fixed;             ///< vertices that never move (inverse mass 0): no conflict; may be empty
    std::size_t size() const { return vertices.size() / stride; }
};

/// Constraints grouped so that within a colour no two write the same vertex.
struct Colouring
{
    std::vector<std::uint32_t> order;        ///< constraint ids, colour by colour, then by lowest vertex
    std::vector<std::uint32_t> colour_start; ///< colour_count + 1 offsets into order
    std::vector<std::uint32_t> hubs;         ///< vertices of more than hub_degree constraints
    /// Constraints at a hub, in no colour: hub_start[h]..hub_start[h+1] of hub_constraints.
    std::vector<std::uint32_t> hub_constraints;
    std::vector<std::uint32_t> hub_start;
    std::size_t colour_count() const { return colour_start.empty() ? 0 : colour_start.size() - 1; }
};

struct ColouringOptions
{
    std::uint32_t hub_degree = 64; ///< vertices with more constraints leave the colouring; 0 = never
    bool balance = true;           ///< move members of large classes to small feasible ones
};

/// Greedy in the order given, lowest feasible colour first, then balanced. At most degree+1 colours
/// for stride 2. Deterministic.
Colouring colour_greedy(const ConstraintGraph& graph, const ColouringOptions& = {});

/// Colours for the springs of a grid by direction and parity: 4 structural, 8 with both diagonals,
/// 12 with the skip-one springs. `kind` as made by grid_springs. Optimal and balanced.
struct GridSpring { std::uint32_t a, b; std::uint8_t colour; };
std::vector<GridSpring> grid_springs(std::uint32_t columns_of_vertices, std::uint32_t rows_of_vertices,
                                     bool diagonals, bool skip_one);

/// Groups springs by their colour field, keeping their order.
Colouring colouring_of(std::span<const GridSpring> springs);

/// True if no two constraints of one colour share a vertex that moves; else says which.
bool valid(const Colouring& colouring, const ConstraintGraph& graph, std::string* why = nullptr);

} // namespace taut
