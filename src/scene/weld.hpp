#pragma once
// From what a file says to a mesh that can be simulated: welding, dropping, naming.

#include "taut/scene/mesh.hpp"
#include "taut/scene/raw_mesh.hpp"

namespace taut::scene_file {

/// For each position the index of the one that it becomes: itself, or an earlier one. 0: equal
/// coordinates; > 0: the first kept position within `distance`; < 0: nothing is welded.
std::vector<std::uint32_t> weld_targets(std::span<const glm::dvec3> positions, double distance);

/// Welds, drops triangles without area, those that stand twice and vertices without triangle, and counts.
/// Keeps file order. `kept`: the vertex of the file that each vertex of the mesh is.
Mesh clean(const RawMesh& raw, double weld_distance, MeshFindings& findings,
           std::vector<std::uint32_t>* kept = nullptr);

/// The text of a mesh file to a mesh; `extension` is ".obj", ".ply", ".off" or ".stl", in any case.
Mesh parse_mesh(std::string_view text, std::string extension, const std::string& file, double weld_distance,
                MeshFindings& findings);

} // namespace taut::scene_file
