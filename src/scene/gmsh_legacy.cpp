// Sections of Gmsh files 1.0 (text) and 2.0 to 2.2 (text and binary).

#include "taut/scene/gmsh.hpp"

namespace taut::scene_file {
namespace {

std::size_t count_line(Values& values, std::size_t numbers, std::size_t bytes, std::string_view what)
{
    // The count is text in either form.
    Words& words = values.words();
    const std::int64_t count = words.to_integer(words.any_word(), "number of " + std::string(what));
    return values.count(count, numbers, bytes, what);
}

void read_nodes(GmshFile& in, std::string_view end)
{
    if (in.solid.closed())
        in.values.fail("there is a second section of vertices; there must be one, before the elements");
    const std::size_t count = count_line(in.values, 4, 28, "vertices");
    in.values.begin_block();
    for (std::size_t v = 0; v < count; ++v)
    {
        const std::int64_t number = in.values.integer(4, "number of a vertex");
        in.solid.add_vertex(number, in.values.position(8));
    }
    in.values.expect(end);
    if (const std::string wrong = in.solid.close_vertices(); !wrong.empty())
        in.values.fail(wrong);
}

void need_vertices(const GmshFile& in)
{
    if (!in.solid.closed())
        in.values.fail("the elements stand before the vertices that they name");
}

std::size_t tag_count(const Values& values, std::int64_t tags)
{
    if (tags < 0 || static_cast<std::uint64_t>(tags) > values.words().left())
        values.fail("an element has " + std::to_string(tags) + " tags; the file has no room for them");
    return static_cast<std::size_t>(tags);
}

/// A header (type, elements that follow, tags of each), then those elements; returns how many.
std::size_t read_binary_block(GmshFile& in, std::size_t left)
{
    Values& values = in.values;
    const std::int64_t type = values.integer(4, "type"), follow = values.integer(4, "number of elements");
    const std::size_t tags = tag_count(values, values.integer(4, "number of tags"));
    if (follow < 1 || static_cast<std::uint64_t>(follow) > left)
        values.fail("a block has " + std::to_string(follow) + " elements; " + std::to_string(left) +
                    " of the announced ones are left");
    gmsh_vertices(values, type); // a known type, before its elements
    for (std::int64_t e = 0; e < follow; ++e)
    {
        const std::int64_t number = values.integer(4, "number of an element");
        values.skip(tags, 4);
        read_gmsh_element(in, type, number, 4);
    }
    return static_cast<std::size_t>(follow);
}

void read_text_element(GmshFile& in)
{
    const std::int64_t number = in.values.integer(4, "number of an element");
    const std::int64_t type = in.values.integer(4, "type of an element");
    in.values.skip(tag_count(in.values, in.values.integer(4, "number of tags")), 4);
    read_gmsh_element(in, type, number, 4);
}

} // namespace

void read_gmsh1_nodes(GmshFile& in) { read_nodes(in, "$ENDNOD"); }
void read_gmsh2_nodes(GmshFile& in) { read_nodes(in, "$EndNodes"); }

void read_gmsh1_elements(GmshFile& in)
{
    need_vertices(in);
    const std::size_t count = count_line(in.values, 6, 4, "elements");
    for (std::size_t e = 0; e < count; ++e)
    {
        const std::int64_t number = in.values.integer(4, "number of an element");
        const std::int64_t type = in.values.integer(4, "type of an element");
        in.values.skip(2, 4); // physical and elementary entity
        const std::int64_t vertices = in.values.integer(4, "number of vertices");
        if (vertices != static_cast<std::int64_t>(gmsh_vertices(in.values, type)))
            in.values.fail("element " + std::to_string(number) + " of type " + std::to_string(type) +
                           " has " + std::to_string(vertices) + " vertices; it must have " +
                           std::to_string(gmsh_vertices(in.values, type)));
        read_gmsh_element(in, type, number, 4);
    }
    in.values.expect("$ENDELM");
}

void read_gmsh2_elements(GmshFile& in)
{
    need_vertices(in);
    const std::size_t count = count_line(in.values, 4, 8, "elements");
    in.values.begin_block();
    if (in.values.binary())
        for (std::size_t left = count; left > 0;)
            left -= read_binary_block(in, left);
    else
        for (std::size_t e = 0; e < count; ++e)
            read_text_element(in);
    in.values.expect("$EndElements");
}

} // namespace taut::scene_file
