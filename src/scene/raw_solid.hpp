#pragma once
// What a file of tetrahedra says, before it is made sound; and the readers of each format, strict as those of
// raw_mesh.hpp.

#include "taut/scene/mesh.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

struct RawSolid
{
    std::vector<glm::dvec3> positions;                     ///< finite, in file order
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< indices in range, of four different vertices
};

struct NamedText
{
    std::string_view text;
    const std::string& file;
};

/// All throw Error{bad_input} naming `file` and the line or byte, what is there and what would be right.
RawSolid read_medit(std::string_view text, const std::string& file);
RawSolid read_gmsh(std::string_view text, const std::string& file);
RawSolid read_vtk(std::string_view text, const std::string& file);
/// Throws Error{unsupported} in a build without Expat, which reads its XML.
RawSolid read_vtu(std::string_view text, const std::string& file);
RawSolid read_tetgen(const NamedText& node, const NamedText& ele);

/// The text of a file of tetrahedra to a mesh; `extension` in any case. TetGen's pairs: parse_tetgen.
Mesh parse_tetrahedra(std::string_view text, std::string extension, const std::string& file,
                      MeshFindings& findings);
Mesh parse_tetgen(const NamedText& node, const NamedText& ele, MeshFindings& findings);

} // namespace taut::scene_file
