#pragma once
// A fine surface within coarse tetrahedra: each of its vertices keeps its barycentric weights in one of them.

#include "taut/scene/mesh.hpp"

#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace taut {

struct Embedding
{
    Mesh surface;                           ///< at rest, world, m
    std::vector<std::uint32_t> tetrahedron; ///< one per vertex of the surface: an index of Mesh::tetrahedra
    std::vector<glm::dvec4> weights;        ///< one per vertex, of its corners: sum 1; negative outside
    bool used() const { return !tetrahedron.empty(); }
};

} // namespace taut
