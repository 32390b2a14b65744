#pragma once
// Internal to src/plan: the shape of the tree of triangles that meet others (kernels/contact). It is fixed by
// where they start; boxes are refitted on the device.

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// A triangle of a surface, and what of it is its own to look after.
struct ContactLeaf
{
    std::array<std::uint32_t, 3> corner{}; ///< plan vertices
    std::uint32_t body = 0;
    std::uint32_t owns = 0; ///< bits as of layout::ContactTriangle
};

/// Leaves of the full binary tree over `count` triangles: the least power of two that holds them.
std::uint32_t leaves_for(std::uint32_t count);

/// The triangles in the order of the leaves: halves by the middle of their centres along the longest side of
/// these, equals by their number, the first half filled before the second.
std::vector<ContactLeaf> in_tree_order(std::vector<ContactLeaf> triangles, std::span<const glm::dvec3> x);

/// Gives every vertex and every side to the first triangle that has it.
void share_out(std::vector<ContactLeaf>& leaves);

} // namespace taut
