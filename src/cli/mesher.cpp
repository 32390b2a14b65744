// TetGen takes an OFF file and switches; Gmsh takes a discrete surface (MSH 2.2) and a script that says that
// it bounds a volume. Neither moves the corners of the surface.

#include "taut/cli/mesher.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cmath>

namespace taut::cli {
namespace {

std::string position(const glm::dvec3& p) { return shown(p.x) + " " + shown(p.y) + " " + shown(p.z) + "\n"; }

/// Of one triangle, vertices numbered from `first`, up to the line end.
std::string corners(const std::array<std::uint32_t, 3>& triangle, std::uint64_t first)
{
    std::string text;
    for (const std::uint32_t corner : triangle)
        text += " " + std::to_string(corner + first);
    return text + "\n";
}

std::vector<std::string> prepare_tetgen(const std::filesystem::path& folder, const Mesh& surface,
                                        double max_volume)
{
    std::string text = "OFF\n" + std::to_string(surface.positions.size()) + " " +
                       std::to_string(surface.triangles.size()) + " 0\n";
    for (const glm::dvec3& p : surface.positions)
        text += position(p);
    for (const auto& triangle : surface.triangles)
        text += "3" + corners(triangle, 0);
    write_file(folder / "surface.off", text);
    // p: fill a surface; q: well-shaped tetrahedra; a: none larger than this
    return {"-pq" + (max_volume > 0 ? "a" + shown(max_volume) : std::string()), "surface.off"};
}

std::vector<std::string> prepare_gmsh(const std::filesystem::path& folder, const Mesh& surface,
                                      double max_volume)
{
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(surface.positions.size()) + "\n";
    for (std::size_t v = 0; v < surface.positions.size(); ++v)
        text += std::to_string(v + 1) + " " + position(surface.positions[v]);
    text += "$EndNodes\n$Elements\n" + std::to_string(surface.triangles.size()) + "\n";
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        text += std::to_string(t + 1) + " 2 2 0 1" + corners(surface.triangles[t], 1);
    write_file(folder / "surface.msh", text + "$EndElements\n");
    write_file(folder / "volume.geo",
               "Merge \"surface.msh\";\nSurface Loop(1) = {1};\nVolume(1) = {1};\nMesh.SaveAll = 1;\n");
    std::vector<std::string> arguments = {"-3", "-format", "msh2", "-o", "volume.msh"};
    if (max_volume > 0) // the edge of a regular tetrahedron of this volume
        arguments.insert(arguments.end(), {"-clmax", shown(std::cbrt(6 * std::sqrt(2.0) * max_volume))});
    arguments.push_back("volume.geo");
    return arguments;
}

} // namespace

const std::vector<Mesher>& meshers()
{
    static const std::vector<Mesher> all = {{"tetgen", prepare_tetgen, "surface.1.ele"},
                                            {"gmsh", prepare_gmsh, "volume.msh"}};
    return all;
}

} // namespace taut::cli
