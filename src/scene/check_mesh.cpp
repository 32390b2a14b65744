// Meshes that a scene brings along.

#include "taut/scene/checker.hpp"

namespace taut::scene_file {
namespace {

/// The member of the body that its tetrahedra come from.
const char* source_of_tetrahedra(ShapeKind kind)
{
    switch (kind)
    {
    case ShapeKind::box: return "box";
    case ShapeKind::ball: return "ball";
    case ShapeKind::tetrahedra: return "tetrahedra";
    default: return "mesh.tetrahedra";
    }
}

void check_volumes(const Mesh& mesh, ShapeKind kind, const Checker& out)
{
    std::size_t flat = 0, first = 0;
    for (std::size_t k = mesh.tetrahedra.size(); k-- > 0;)
        if (!(six_volumes(mesh.positions, mesh.tetrahedra[k]) > 0))
            ++flat, first = k;
    if (flat > 0)
        out.error(source_of_tetrahedra(kind),
                  "has " + std::to_string(flat) + " of " + std::to_string(mesh.tetrahedra.size()) +
                      " tetrahedra without volume, or left-handed; the first is number " +
                      std::to_string(first) + " (from 0). A mesh must not be flat, nor scaled to nothing",
                  ErrorCode::degenerate_rest);
}

} // namespace

void check_mesh(const Mesh& mesh, ShapeKind kind, const Checker& out)
{
    const std::size_t count = mesh.positions.size();
    bool sound = true; // every element names vertices that are there
    for (std::size_t v = 0; v < count; ++v)
        out.at("mesh.positions", v).finite("", mesh.positions[v], "m");
    const auto corners = [&](std::string_view list, std::size_t index, const auto& vertices) {
        for (const std::uint32_t vertex : vertices)
            if (vertex >= count)
            {
                sound = false;
                out.at(list, index)
                    .error("", "names vertex " + std::to_string(vertex) + "; the mesh has " +
                                   std::to_string(count) + ", numbered from 0");
            }
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        corners("mesh.triangles", t, mesh.triangles[t]);
    for (std::size_t k = 0; k < mesh.links.size(); ++k)
        corners("mesh.links", k, mesh.links[k]);
    for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k)
        corners("mesh.tetrahedra", k, mesh.tetrahedra[k]);
    if (sound)
        check_volumes(mesh, kind, out);
    if (mesh.grid_columns != 0 && std::size_t(mesh.grid_columns) * mesh.grid_rows != count)
        out.error("mesh", "says " + std::to_string(mesh.grid_columns) + " x " +
                              std::to_string(mesh.grid_rows) + " vertices and has " + std::to_string(count));
}

} // namespace taut::scene_file
