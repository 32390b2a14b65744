// Sections of Gmsh files 4.1, text and binary: blocks of vertices and of elements of one entity each.

#include "taut/scene/gmsh.hpp"

namespace taut::scene_file {
namespace {

struct Head
{
    std::size_t blocks = 0, entries = 0;
};

/// Counts, then the least and the largest number of an entry.
Head read_head(GmshFile& in, std::size_t numbers, std::size_t bytes, std::string_view what)
{
    Values& values = in.values;
    values.begin_block();
    Head head;
    const std::int64_t blocks = values.integer(in.size_bytes, "number of blocks");
    const std::int64_t entries = values.integer(in.size_bytes, "number of " + std::string(what));
    values.skip(2, in.size_bytes);
    head.blocks = values.count(blocks, 4, 12 + in.size_bytes, "blocks");
    head.entries = values.count(entries, numbers, bytes, what);
    return head;
}

/// Entries of the next block.
std::size_t block_entries(GmshFile& in, std::size_t left, std::string_view what)
{
    const std::int64_t count = in.values.integer(in.size_bytes, "number of " + std::string(what));
    if (count < 0 || static_cast<std::uint64_t>(count) > left)
        in.values.fail("a block has " + std::to_string(count) + " " + std::string(what) + "; " +
                       std::to_string(left) + " of the announced ones are left");
    return static_cast<std::size_t>(count);
}

void all_there(const GmshFile& in, std::size_t left, std::string_view what)
{
    if (left > 0)
        in.values.fail("the blocks end " + std::to_string(left) + " " + std::string(what) +
                       " before the announced number");
}

/// All numbers of a block come before its positions.
std::size_t read_node_block(GmshFile& in, std::size_t left)
{
    Values& values = in.values;
    const std::int64_t dimension = values.integer(4, "dimension");
    values.integer(4, "entity");
    const std::int64_t parametric = values.integer(4, "whether there are parameters");
    if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1)
        values.fail("a block has the dimension " + std::to_string(dimension) + " and the mark " +
                    std::to_string(parametric) + "; they must be 0 to 3, and 0 or 1");
    const std::size_t count = block_entries(in, left, "vertices");
    std::vector<std::int64_t> numbers;
    for (std::size_t v = 0; v < count; ++v)
        numbers.push_back(values.integer(in.size_bytes, "number of a vertex"));
    for (const std::int64_t number : numbers)
    {
        in.solid.add_vertex(number, values.position(8));
        values.skip(parametric == 1 ? static_cast<std::size_t>(dimension) : 0, 8);
    }
    return count;
}

std::size_t read_element_block(GmshFile& in, std::size_t left)
{
    Values& values = in.values;
    values.integer(4, "dimension");
    values.integer(4, "entity");
    const std::int64_t type = values.integer(4, "type of elements");
    gmsh_vertices(values, type); // a known type, before its elements
    const std::size_t count = block_entries(in, left, "elements");
    for (std::size_t e = 0; e < count; ++e)
    {
        const std::int64_t number = values.integer(in.size_bytes, "number of an element");
        read_gmsh_element(in, type, number, in.size_bytes);
    }
    return count;
}

} // namespace

void read_gmsh4_nodes(GmshFile& in)
{
    if (in.solid.closed())
        in.values.fail("there is a second section of vertices; there must be one, before the elements");
    const Head head = read_head(in, 4, in.size_bytes + 24, "vertices");
    std::size_t left = head.entries;
    for (std::size_t b = 0; b < head.blocks; ++b)
        left -= read_node_block(in, left);
    all_there(in, left, "vertices");
    in.values.expect("$EndNodes");
    if (const std::string wrong = in.solid.close_vertices(); !wrong.empty())
        in.values.fail(wrong);
}

void read_gmsh4_elements(GmshFile& in)
{
    if (!in.solid.closed())
        in.values.fail("the elements stand before the vertices that they name");
    const Head head = read_head(in, 2, 2 * in.size_bytes, "elements");
    std::size_t left = head.entries;
    for (std::size_t b = 0; b < head.blocks; ++b)
        left -= read_element_block(in, left);
    all_there(in, left, "elements");
    in.values.expect("$EndElements");
}

} // namespace taut::scene_file
