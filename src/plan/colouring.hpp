#pragma once
// Groups constraints so that the members of one group can be solved at once. docs/colouring.md.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut {

/// A constraint as a colouring sees it: the vertices it writes. `stride` vertices each.
struct ConstraintGraph
{
    std::uint32_t vertex_count = 0;
    std::uint32_t stride = 2;
    std::vector<std::uint32_t> vertices; ///< constraint_count * stride
    std::vector<bool> fixed; ///< vertices that never move (inverse mass 0): no conflict; may be empty
    std::size_t size() const { return vertices.size() / stride; }
};

/// Constraints grouped so that within a colour no two write the same vertex.
struct Colouring
{
    std::vector<std::uint32_t> order;        ///< constraint ids, colour by colour, then by lowest vertex
    std::vector<std::uint32_t> colour_start; ///< colour_count + 1 offsets into order; no colour is empty
    /// Vertices of more than hub_degree constraints, ascending; those that own none are left out.
    std::vector<std::uint32_t> hubs;
    /// Constraints at a hub, in no colour: hub_start[h]..hub_start[h+1] of hub_constraints, ascending.
    /// A constraint between two hubs belongs to the lower one. Members of one list share the hub and
    /// may share other vertices, and two lists may share vertices: solve them one after another.
    std::vector<std::uint32_t> hub_constraints;
    std::vector<std::uint32_t> hub_start; ///< hubs + 1
    std::size_t colour_count() const { return colour_start.empty() ? 0 : colour_start.size() - 1; }
};

struct ColouringOptions
{
    std::uint32_t hub_degree = 64; ///< vertices with more constraints leave the colouring; 0 = never
    bool balance = true;           ///< dissolve small classes, then even out the others
};

/// Greedy in the order given, lowest feasible colour first, then balanced. For stride 2 at most
/// degree + 1 colours, where degree is the largest number of coloured constraints at one moving
/// vertex; pairs of vertices that occur more than once may cost more. Deterministic.
Colouring colour_greedy(const ConstraintGraph& graph, const ColouringOptions& = {});

/// Colours for the springs of a grid by direction and parity: 4 structural, 8 with both diagonals,
/// 12 with the skip-one springs. Ordered by colour, then row by row. Optimal and balanced.
struct GridSpring
{
    std::uint32_t a, b;
    std::uint8_t colour;
};
std::vector<GridSpring> grid_springs(std::uint32_t columns_of_vertices, std::uint32_t rows_of_vertices,
                                     bool diagonals, bool skip_one);

/// Groups springs by their colour field, keeping their order; colours without a spring are dropped.
Colouring colouring_of(std::span<const GridSpring> springs);

/// True if every constraint is in one place (a colour or a hub that it touches) and no two of one
/// colour share a vertex that moves; else says in a sentence which.
bool valid(const Colouring& colouring, const ConstraintGraph& graph, std::string* why = nullptr);

} // namespace taut
