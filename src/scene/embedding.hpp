#pragma once
// Fine surfaces within coarse tetrahedra: where they lie at rest, and where that leaves them later.

#include "taut/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

struct EmbeddingFindings
{
    std::size_t outside = 0; ///< vertices that no tetrahedron holds
    std::size_t far = 0;     ///< of those: further from theirs than its longest edge
    std::uint32_t first_far = 0;
    double first_distance = 0; ///< m, of that one from its tetrahedron
};

/// Finds for each vertex of `surface` the tetrahedron of `solid` that holds it, or else the one whose point
/// with the vertex' weights, negative ones taken for 0, is nearest. `solid` has tetrahedra. O(n) where they
/// are of even size: a uniform grid.
Embedding embed(Mesh surface, const Mesh& solid, EmbeddingFindings* findings = nullptr);

/// m, where the vertices of the surface are when those of the solid are at `positions`. Maps that are linear
/// are carried over to rounding.
std::vector<glm::dvec3> carry(const Embedding& embedding, const Mesh& solid,
                              std::span<const glm::dvec3> positions);

/// Whether any body of a resolved scene has an embedded surface.
bool any_embedding(const Scene& resolved);

/// The scene as it is shown: bodies with an embedded surface have that for a mesh, without tetrahedra.
Scene shown_scene(const Scene& resolved);
/// The places of its vertices; `positions` are those of the resolved scene, m.
std::vector<glm::dvec3> shown_positions(const Scene& resolved, std::span<const glm::dvec3> positions);

} // namespace taut
