#pragma once
// Reference R1: where the material of a scene comes to rest when its meshes are refined without end.

#include "taut/report/errors.hpp"
#include "taut/scene/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace taut {

/// Vertices of the finest mesh at most: a step of Newton's method in long double takes a tenth of a second
/// for so many.
inline constexpr std::size_t kMostContinuumVertices = 6000;

struct ContinuumReference
{
    std::string reason;                ///< why there is none; empty where it can be trusted
    std::string text;                  ///< one sentence: the meshes, the order, its own error
    std::vector<std::size_t> vertices; ///< of each mesh, the coarsest first
    double order = 0;                  ///< observed: errors fall by cells^-order
    double error = 0;                  ///< estimate of its own error, as e_disp
    double mesh_error = 0;             ///< of the equilibrium on the scene's own mesh, as e_disp
    std::vector<glm::dvec3> positions; ///< m, of the vertices of the scene's own mesh
    std::vector<glm::dvec3> own;       ///< m, where they come to rest on it
};

/// Solves the scene at rest (R2, reference_static.hpp) on its own mesh and with twice and four times the
/// cells; where that is too much, with half, once and twice. Extrapolates by Richardson (Roache 1998, 5.4),
/// with the order that the three show. Without a sound answer: bodies that are files, or say something of
/// single vertices; what R2 refuses or does not model; an order outside 0.7 to 4.3; an own error above 0.65
/// of the mesh's. A pin's box should end on a line of the mesh: what it holds must not change with the cells.
/// `scene` as it was loaded, not resolved. Throws what resolve() throws.
ContinuumReference continuum_reference(const Scene& scene);

} // namespace taut
