#pragma once
// The parts of a Gmsh file: what its versions share, and the sections of each.

#include "taut/scene/solid_builder.hpp"
#include "taut/scene/values.hpp"

#include <array>

namespace taut::scene_file {

struct GmshFile
{
    GmshFile(std::string_view text, const std::string& file) : values(text, file) {}

    Values values;
    SolidBuilder solid;
    std::size_t size_bytes = 8;   ///< of a count or number in 4.1
    std::size_t second_order = 0; ///< tetrahedra of ten vertices that were met
};

/// Vertices of an element of this type (Gmsh's manual, "Node ordering"); refuses types that are not known.
std::size_t gmsh_vertices(const Values& values, std::int64_t type);

/// The vertices of an element, from their numbers in the file: tetrahedra are kept, others passed over.
void read_gmsh_element(GmshFile& in, std::int64_t type, std::int64_t number, std::size_t bytes);

/// Each from behind its opening line to its closing line. 1.0 is text and has the keywords NOD and ELM.
void read_gmsh1_nodes(GmshFile& in);
void read_gmsh1_elements(GmshFile& in);
void read_gmsh2_nodes(GmshFile& in);
void read_gmsh2_elements(GmshFile& in);
void read_gmsh4_nodes(GmshFile& in);
void read_gmsh4_elements(GmshFile& in);

} // namespace taut::scene_file
