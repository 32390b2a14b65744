// Gmsh (.msh) 1.0, 2.0 to 2.2 and 4.1, text and binary of both byte orders: vertices and tetrahedra of four
// vertices. Other elements and sections are passed over.
// Based on: the Gmsh reference manual, "MSH file format" and its legacy versions.

#include "taut/scene/gmsh.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace taut::scene_file {
namespace {

/// Vertices of the element types 1 to 31; 92 and 93 are bricks.
constexpr std::array<std::size_t, 31> kVertices = {2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1, 8,
                                                   20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
constexpr std::int64_t kTetrahedron = 4, kTetrahedron10 = 11;

struct Section
{
    std::string_view version, name; ///< "" in a file without $MeshFormat
    void (*read)(GmshFile&);
};
constexpr Section kSections[] = {
    {"", "$NOD", read_gmsh1_nodes},      {"", "$ELM", read_gmsh1_elements},
    {"2", "$Nodes", read_gmsh2_nodes},   {"2", "$Elements", read_gmsh2_elements},
    {"4.1", "$Nodes", read_gmsh4_nodes}, {"4.1", "$Elements", read_gmsh4_elements},
};

/// After the line that says binary: the number one tells the byte order.
void read_byte_order(Values& values)
{
    values.set_form(Form::little_endian);
    values.begin_block();
    const std::int64_t one = values.integer(4, "the number one");
    if (one == 0x01000000)
        values.set_form(Form::big_endian);
    else if (one != 1)
        values.fail("the bytes behind the format must be the number 1 in either byte order");
}

/// "2" or "4.1"
std::string_view read_format(GmshFile& in)
{
    Words& words = in.values.words();
    const std::string_view version = words.any_word();
    double number = 0; // some write "2.000000"
    const auto read = std::from_chars(version.data(), version.data() + version.size(), number);
    const bool whole = read.ec == std::errc() && read.ptr == version.data() + version.size();
    const bool two = whole && (number == 2 || number == 2.1 || number == 2.2);
    if (!two && !(whole && number == 4.1))
        words.fail("the version is " + quoted(version) +
                   "; 2.0 to 2.2 and 4.1 are read, and 1.0, whose files have no " +
                   "$MeshFormat and begin with $NOD");
    const std::string_view form = words.any_word(), size = words.any_word();
    if (form != "0" && form != "1")
        words.fail("the file type is " + quoted(form) + "; it must be 0 (text) or 1 (binary)");
    if (size != "8" && !(size == "4" && !two))
        words.fail("the data size is " + quoted(size) + "; it must be 8");
    in.size_bytes = size == "4" ? 4 : 8;
    if (form == "1")
        read_byte_order(in.values);
    in.values.expect("$EndMeshFormat");
    return two ? "2" : "4.1";
}

/// To behind the line that closes a section.
void pass_section(Values& values, std::string_view name)
{
    const std::string end = "$End" + std::string(name.substr(1));
    if (!values.words().skip_past(end))
        values.fail("the section " + quoted(name) + " has no end; \"" + end + "\" must stand behind it");
}

void read_section(GmshFile& in, std::string_view version, std::string_view word)
{
    for (const Section& section : kSections)
        if (section.name == word && section.version == version)
            return section.read(in);
    if (word == "$Nodes" || word == "$Elements")
        in.values.fail(quoted(word) + " stands before \"$MeshFormat\", which must say the version");
    pass_section(in.values, word);
}

} // namespace

std::size_t gmsh_vertices(const Values& values, std::int64_t type)
{
    if (type == 92 || type == 93)
        return type == 92 ? 64 : 125;
    if (type < 1 || type > static_cast<std::int64_t>(kVertices.size()))
        values.fail("an element has the type " + std::to_string(type) +
                    "; the types 1 to 31, 92 and 93 are known, and 4 is the tetrahedron");
    return kVertices[static_cast<std::size_t>(type - 1)];
}

void read_gmsh_element(GmshFile& in, std::int64_t type, std::int64_t number, std::size_t bytes)
{
    in.second_order += type == kTetrahedron10;
    if (type != kTetrahedron)
        return in.values.skip(gmsh_vertices(in.values, type), bytes);
    std::array<std::int64_t, 4> corners{};
    for (std::int64_t& corner : corners)
        corner = in.values.integer(bytes, "corner of a tetrahedron");
    if (const std::string wrong = in.solid.add_tetrahedron(number, corners); !wrong.empty())
        in.values.fail(wrong);
}

RawSolid read_gmsh(std::string_view text, const std::string& file)
{
    GmshFile in(text, file);
    std::string_view version;
    for (std::string_view word = in.values.words().any_word(); !word.empty();
         word = in.values.words().any_word())
    {
        if (!word.starts_with('$'))
            in.values.fail("there is " + quoted(word) + " where a section ($Nodes, $Elements) must begin");
        if (word == "$MeshFormat")
            version = read_format(in);
        else
            read_section(in, version, word);
    }
    if (in.second_order > 0)
        in.values.fail("it has " + std::to_string(in.second_order) +
                       " tetrahedra of ten vertices; they must have 4 (in Gmsh: set order 1)");
    return in.solid.take();
}

} // namespace taut::scene_file
