// Legacy VTK files (.vtk) of unstructured grids, text and binary (big endian): points and cells of the type
// tetrahedron. Other cells are passed over, attributes are not read.
// Based on: "VTK File Formats" of the VTK documentation, versions 2.0 to 5.1.

#include "taut/scene/solid_builder.hpp"
#include "taut/scene/values.hpp"
#include "taut/scene/vtk_cells.hpp"

#include <algorithm>

namespace taut::scene_file {
namespace {

struct VtkType
{
    std::string_view name;
    std::size_t bytes;
};
constexpr VtkType kVtkTypes[] = {
    {"char", 1},      {"unsigned_char", 1},  {"vtktypeint8", 1},  {"vtktypeuint8", 1},
    {"short", 2},     {"unsigned_short", 2}, {"vtktypeint16", 2}, {"vtktypeuint16", 2},
    {"int", 4},       {"unsigned_int", 4},   {"vtktypeint32", 4}, {"vtktypeuint32", 4},
    {"long", 8},      {"unsigned_long", 8},  {"vtktypeint64", 8}, {"vtktypeuint64", 8},
    {"vtkIdType", 4}, {"float", 4},          {"double", 8}};

std::size_t bytes_of(std::string_view name, const Values& values)
{
    const auto found = std::find_if(std::begin(kVtkTypes), std::end(kVtkTypes),
                                    [&](const VtkType& t) { return t.name == name; });
    if (found == std::end(kVtkTypes))
        values.fail("the type " + quoted(name) +
                    " is not known; it must be one such as int, float or double");
    return found->bytes;
}

struct Reader
{
    Reader(std::string_view text, const std::string& file) : values(text, file) {}

    Values values;
    bool offsets = false; ///< cells as offsets and connectivity, since 5.0
    std::vector<glm::dvec3> points;
    VtkCells cells;
    bool typed = false;
};

std::int64_t word_integer(Values& values, std::string_view what)
{
    return values.words().to_integer(values.words().any_word(), what);
}

void read_head(Reader& in)
{
    Words& words = in.values.words();
    constexpr std::string_view start = "# vtk DataFile Version ";
    const std::string_view first = words.raw_line();
    if (!first.starts_with(start))
        words.fail("the file does not start with \"" + std::string(start) + "\" as a legacy VTK file must");
    in.offsets = words.to_number(first.substr(start.size(), 3), "the version") >= 5;
    words.raw_line(); // the title
    const std::string_view form = words.any_word();
    if (form != "ASCII" && form != "BINARY")
        words.fail("there is " + quoted(form) + " where ASCII or BINARY must stand");
    in.values.expect("DATASET");
    if (const std::string_view set = words.any_word(); set != "UNSTRUCTURED_GRID")
        words.fail("the data set is " + quoted(set) + "; it must be UNSTRUCTURED_GRID");
    in.values.set_form(form == "ASCII" ? Form::text : Form::big_endian);
}

void read_points(Reader& in)
{
    const std::int64_t announced = word_integer(in.values, "number of points");
    const std::string_view type = in.values.words().any_word();
    if (type != "float" && type != "double")
        in.values.fail("points have the type " + quoted(type) + "; it must be float or double");
    const std::size_t bytes = bytes_of(type, in.values);
    const std::size_t count = in.values.count(announced, 3, 3 * bytes, "points");
    in.values.begin_block();
    for (std::size_t v = 0; v < count; ++v)
        in.points.push_back(in.values.position(bytes));
}

/// Of each cell the number of its points, then these.
void read_counted_cells(Reader& in)
{
    const std::int64_t announced = word_integer(in.values, "number of cells");
    const std::int64_t size = word_integer(in.values, "size of the cells");
    const std::size_t count = in.values.count(announced, 1, 4, "cells");
    std::size_t left = in.values.count(size, 1, 4, "numbers of cells");
    in.values.begin_block();
    for (std::size_t c = 0; c < count; ++c)
    {
        const std::int64_t corners = in.values.integer(4, "number of points of a cell");
        if (corners < 0 || left == 0 || static_cast<std::uint64_t>(corners) > left - 1)
            in.values.fail("cell " + std::to_string(c) + " has " + std::to_string(corners) +
                           " points; the announced numbers have no room for them");
        left -= static_cast<std::size_t>(corners) + 1;
        for (std::int64_t k = 0; k < corners; ++k)
            in.cells.connectivity.push_back(in.values.integer(4, "point of a cell"));
        in.cells.ends.push_back(static_cast<std::int64_t>(in.cells.connectivity.size()));
    }
}

std::vector<std::int64_t> read_array(Reader& in, std::string_view name, std::int64_t announced)
{
    in.values.expect(name);
    const std::size_t bytes = bytes_of(in.values.words().any_word(), in.values);
    const std::size_t count = in.values.count(announced, 1, bytes, "numbers of cells");
    in.values.begin_block();
    std::vector<std::int64_t> out;
    for (std::size_t k = 0; k < count; ++k)
        out.push_back(in.values.integer(bytes, "a number of a cell"));
    return out;
}

/// Where each cell starts and where the last one ends, then the points of all cells.
void read_offset_cells(Reader& in)
{
    const std::int64_t offsets = word_integer(in.values, "number of offsets");
    const std::int64_t size = word_integer(in.values, "size of the cells");
    in.cells.ends = read_array(in, "OFFSETS", offsets);
    if (!in.cells.ends.empty())
    {
        if (in.cells.ends.front() != 0)
            in.values.fail("the first offset is " + std::to_string(in.cells.ends.front()) + "; it must be 0");
        in.cells.ends.erase(in.cells.ends.begin());
    }
    in.cells.connectivity = read_array(in, "CONNECTIVITY", size);
}

void read_types(Reader& in)
{
    const std::size_t count =
        in.values.count(word_integer(in.values, "number of types"), 1, 4, "types of cells");
    in.values.begin_block();
    for (std::size_t c = 0; c < count; ++c)
        in.cells.types.push_back(in.values.integer(4, "type of a cell"));
    in.typed = true;
}

/// Arrays of anything, which some writers put before the points.
void pass_field(Reader& in)
{
    Words& words = in.values.words();
    words.any_word(); // its name
    for (std::int64_t left = word_integer(in.values, "number of arrays"); left > 0; --left)
    {
        if (words.any_word().empty())
            in.values.fail("the file ends in the middle of its fields");
        const std::int64_t components = word_integer(in.values, "number of components");
        const std::int64_t tuples = word_integer(in.values, "number of tuples");
        const std::size_t bytes = bytes_of(words.any_word(), in.values);
        const std::size_t each = in.values.count(components, 1, bytes, "components");
        const std::size_t count = in.values.count(tuples, 1, bytes, "tuples");
        if (each > 0 && count > words.left() / each)
            in.values.fail("an array of a field is larger than the file");
        in.values.begin_block();
        in.values.skip(each * count, bytes);
    }
}

/// From behind its keyword to behind the empty line that ends it.
void pass_metadata(Words& words)
{
    words.end_line();
    while (words.left() > 0 && !words.raw_line().empty())
    {}
}

/// True while the grid goes on.
bool read_section(Reader& in, std::string_view word)
{
    if (word.empty() || word == "POINT_DATA" || word == "CELL_DATA")
        return false;
    if (word == "POINTS" && in.points.empty())
        read_points(in);
    else if (word == "CELLS" && in.cells.ends.empty())
        in.offsets ? read_offset_cells(in) : read_counted_cells(in);
    else if (word == "CELL_TYPES" && !in.typed)
        read_types(in);
    else if (word == "FIELD")
        pass_field(in);
    else if (word == "METADATA")
        pass_metadata(in.values.words());
    else
        in.values.fail("there is " + quoted(word) +
                       " where POINTS, CELLS, CELL_TYPES (each once), CELL_DATA or POINT_DATA must stand");
    return true;
}

} // namespace

RawSolid read_vtk(std::string_view text, const std::string& file)
{
    Reader in(text, file);
    read_head(in);
    while (read_section(in, in.values.words().any_word()))
    {}
    SolidBuilder solid;
    const std::string wrong = add_vtk_cells(in.points, in.cells, solid);
    if (!wrong.empty())
        in.values.fail(wrong);
    return solid.take();
}

} // namespace taut::scene_file
