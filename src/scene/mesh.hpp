#pragma once
// Meshes of triangles and tetrahedra as values, their readers, writers and checks.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace taut {

struct Mesh
{
    std::vector<glm::dvec3> positions; ///< m
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Texture coordinates of the corners of each triangle, of the mesh file; not finite where a face has
    /// none. Empty: the file has none, or the mesh is generated.
    std::vector<std::array<glm::dvec2, 3>> texture;
    /// Edges that belong to no triangle: the links of a chain.
    std::vector<std::array<std::uint32_t, 2>> links;
    double link_width = 0; ///< m, width of cloth that a link stands for
    /// Of a solid, right-handed: ((b - a) x (c - a)) . (d - a) > 0. `triangles` is its surface then, seen
    /// counter-clockwise from outside.
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    /// Set for generated grids: vertices per row and number of rows; else 0.
    std::uint32_t grid_columns = 0, grid_rows = 0;
};

/// What welding and checking found in a mesh file.
struct MeshFindings
{
    std::size_t welded_vertices = 0;
    std::size_t unused_vertices = 0;                              ///< dropped
    std::vector<std::uint32_t> degenerate_triangles;              ///< dropped; index in the file
    std::vector<std::uint32_t> repeated_triangles;                ///< of an earlier one's corners; likewise
    std::vector<std::array<std::uint32_t, 2>> non_manifold_edges; ///< more than two triangles
    std::size_t boundary_edges = 0;
    std::size_t turned_tetrahedra = 0; ///< left-handed in the file
    std::map<std::string, std::size_t> skipped; ///< lines of an OBJ that are not read, by their first word
};

/// What is to be said of MeshFindings::skipped, a kind each: "has 94 lines \"seam\", which are not read".
std::vector<std::string> skipped_texts(const std::map<std::string, std::size_t>& skipped);

/// OBJ, PLY, OFF, STL. Throws Error{io} or Error{bad_input} naming file and what is wrong.
Mesh read_mesh(const std::filesystem::path& file, double weld_distance, MeshFindings* findings = nullptr);

/// (columns+1) x (rows+1) vertices, row by row from the top left.
Mesh make_grid(std::uint32_t columns, std::uint32_t rows, double width, double height, bool alternating);

/// links + 1 vertices along -y from the origin.
Mesh make_chain(std::uint32_t links, double length, double width);

/// (x + 1)(y + 1)(z + 1) vertices, x fastest, then y, then z, centred at the origin. Every cell becomes five
/// tetrahedra, mirrored from cell to cell, or six round the diagonal along +++ (Kuhn).
Mesh make_box(const std::array<std::uint32_t, 3>& cells, const glm::dvec3& size, bool five);

/// A cube of `cells` along each edge, blown up to a ball: each of its shells becomes a sphere.
Mesh make_ball(std::uint32_t cells, double radius);

/// Six times the signed volume, m^3: ((b - a) x (c - a)) . (d - a).
double six_volumes(const std::vector<glm::dvec3>& positions, const std::array<std::uint32_t, 4>& corners);

/// The faces of exactly one tetrahedron, seen counter-clockwise from outside, in the order of their
/// tetrahedra.
std::vector<std::array<std::uint32_t, 3>>
surface_of(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra);

/// Tetrahedra as a file gives them, made sound: left-handed ones are turned and counted, vertices of none are
/// dropped and counted, `triangles` becomes the surface. Throws Error{degenerate_rest} naming the first
/// tetrahedron without volume (below 1e-12 of its longest edge cubed), and how many others there are.
Mesh solid_mesh(std::vector<glm::dvec3> positions, std::vector<std::array<std::uint32_t, 4>> tetrahedra,
                const std::string& name, MeshFindings& findings);

/// TetGen (.node with its .ele, either named), Gmsh (.msh), legacy VTK (.vtk), Medit (.mesh). Throws
/// Error{io} or Error{bad_input} naming file, line and what is wrong.
Mesh read_tetrahedra(const std::filesystem::path& file, MeshFindings* findings = nullptr);

/// Written to a temporary name, then renamed. Throws Error{io}.
void write_obj(const std::filesystem::path& file, const Mesh& mesh);

} // namespace taut
