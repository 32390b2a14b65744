#pragma once
// Triangle meshes as values, their readers, writers and checks.

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace taut {

struct Mesh
{
    std::vector<glm::dvec3> positions; ///< m
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Edges that belong to no triangle: the links of a chain.
    std::vector<std::array<std::uint32_t, 2>> links;
    double link_width = 0; ///< m, width of cloth that a link stands for
    /// Set for generated grids: vertices per row and number of rows; else 0.
    std::uint32_t grid_columns = 0, grid_rows = 0;
};

/// What welding and checking found in a mesh file.
struct MeshFindings
{
    std::size_t welded_vertices = 0;
    std::size_t unused_vertices = 0;                              ///< dropped
    std::vector<std::uint32_t> degenerate_triangles;              ///< dropped; index in the file
    std::vector<std::array<std::uint32_t, 2>> non_manifold_edges; ///< more than two triangles
    std::size_t boundary_edges = 0;
};

/// OBJ, PLY, OFF, STL. Throws Error{io} or Error{bad_input} naming file and what is wrong.
Mesh read_mesh(const std::filesystem::path& file, double weld_distance, MeshFindings* findings = nullptr);

/// (columns+1) x (rows+1) vertices, row by row from the top left.
Mesh make_grid(std::uint32_t columns, std::uint32_t rows, double width, double height, bool alternating);

/// links + 1 vertices along -y from the origin.
Mesh make_chain(std::uint32_t links, double length, double width);

/// Written to a temporary name, then renamed. Throws Error{io}.
void write_obj(const std::filesystem::path& file, const Mesh& mesh);

} // namespace taut
