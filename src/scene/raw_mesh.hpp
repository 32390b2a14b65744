#pragma once
// What a mesh file says, before welding and cleaning; and the readers of each format. They are
// strict, take memory in proportion to the file, and check every index and number (docs/scene.md
// says why they are not a library's).

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

struct RawMesh
{
    std::vector<glm::dvec3> positions;                   ///< finite, in file order
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices in range; larger faces are fanned
    /// Texture coordinates of the corners of each triangle, or empty; not finite where a corner has none.
    std::vector<std::array<glm::dvec2, 3>> texture;
    std::map<std::string, std::size_t> skipped; ///< lines that may mean something and are not read, by word
};

/// All throw Error{bad_input} naming `file` and the line or byte, what is there and what would be right.
RawMesh read_obj(std::string_view text, const std::string& file);
RawMesh read_off(std::string_view text, const std::string& file);
RawMesh read_ply(std::string_view text, const std::string& file);
RawMesh read_stl(std::string_view text, const std::string& file);

/// A file of any of these formats, by its extension. Throws Error{io}, and Error{bad_input} also where a
/// coordinate is beyond 1e30.
RawMesh read_raw_mesh(const std::filesystem::path& file);

/// Squares and cubes of coordinates must stay finite: throws Error{bad_input} naming `file` and the first
/// vertex with a coordinate that is not finite or beyond 1e30.
void check_coordinates(std::span<const glm::dvec3> positions, const std::string& file);

/// What stands for texture coordinates where a file has none.
inline constexpr double kNoTexture = std::numeric_limits<double>::quiet_NaN();

/// Cuts a face into triangles at its first corner.
void add_face(RawMesh& mesh, std::span<const std::uint32_t> corners);

} // namespace taut::scene_file
