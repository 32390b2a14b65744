// VTU files (VTK's XML of unstructured grids): points and tetrahedra of all pieces, from arrays of text or of
// base64. Compressed and appended arrays are refused in words.
// Based on: "VTK File Formats" of the VTK documentation, "XML file formats".

#include "taut/runtime/base/error.hpp"
#include "taut/scene/base64.hpp"
#include "taut/scene/values.hpp"
#include "taut/scene/vtk_cells.hpp"
#include "taut/scene/vtu_text.hpp"

#include <algorithm>
#include <charconv>

namespace taut::scene_file {
namespace {

struct VtuType
{
    std::string_view name;
    std::size_t bytes;
    bool whole;
};
constexpr VtuType kVtuTypes[] = {{"Int8", 1, true},    {"UInt8", 1, true},  {"Int16", 2, true},
                                 {"UInt16", 2, true},  {"Int32", 4, true},  {"UInt32", 4, true},
                                 {"Int64", 8, true},   {"UInt64", 8, true}, {"Float32", 4, false},
                                 {"Float64", 8, false}};

struct Context
{
    const std::string& file;
    const VtuText& xml;

    [[noreturn]] void fail(std::size_t line, const std::string& text) const
    {
        throw Error(ErrorCode::bad_input, file + ": line " + std::to_string(line) + ": " + text);
    }
};

const VtuType& type_of(const Context& in, const VtuArray& array, std::string_view name, bool whole)
{
    const auto found = std::find_if(std::begin(kVtuTypes), std::end(kVtuTypes),
                                    [&](const VtuType& t) { return t.name == array.type; });
    if (found == std::end(kVtuTypes) || found->whole != whole)
        in.fail(array.line, "the array " + std::string(name) + " has the type " +
                                scene_file::quoted(array.type) +
                                (whole ? "; it must be Int8 to UInt64" : "; it must be Float32 or Float64"));
    return *found;
}

std::size_t to_count(const Context& in, std::size_t line, const std::string& word, std::string_view what)
{
    std::size_t value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size())
        in.fail(line, std::string(what) + " is " + scene_file::quoted(word) + "; it must be a whole number");
    return value;
}

/// The bytes behind the base64 of an array, without the count that they start with.
std::string binary_of(const Context& in, const VtuArray& array, std::string_view name)
{
    if (!in.xml.compressor.empty())
        in.fail(array.line, "arrays are compressed (" + scene_file::quoted(in.xml.compressor) +
                                "); save the file as text or without compression");
    const bool big = in.xml.byte_order == "BigEndian";
    if (!big && in.xml.byte_order != "LittleEndian")
        in.fail(array.line, "the byte order is " + scene_file::quoted(in.xml.byte_order) +
                                "; it must be LittleEndian or BigEndian");
    std::string bytes;
    if (!from_base64(array.text, bytes))
        in.fail(array.line, "the array " + std::string(name) + " is not base64");
    const std::size_t head = in.xml.header_type == "UInt64" ? 8 : 4;
    std::uint64_t announced = 0;
    for (std::size_t b = 0; b < head && bytes.size() >= head; ++b)
        announced |= std::uint64_t(static_cast<unsigned char>(bytes[big ? head - 1 - b : b])) << (8 * b);
    if (bytes.size() < head || announced != bytes.size() - head)
        in.fail(array.line, "the array " + std::string(name) + " announces " + std::to_string(announced) +
                                " bytes and has " +
                                std::to_string(bytes.size() - std::min(head, bytes.size())));
    return bytes.substr(head);
}

/// Calls `work` with the numbers of an array, which must be `count`, from front to back.
template <class Work>
void read_array(const Context& in, const VtuArray& array, std::string_view name, const VtuType& type,
                std::size_t count, const Work& work)
{
    const bool binary = array.format == "binary";
    if (!binary && array.format != "ascii")
        in.fail(array.line, "the array " + std::string(name) + " has the format " +
                                scene_file::quoted(array.format) + "; ascii and binary are read");
    const std::string bytes = binary ? binary_of(in, array, name) : std::string();
    Values values(binary ? std::string_view(bytes) : std::string_view(array.text), in.file, array.line);
    if (binary)
        values.set_form(in.xml.byte_order == "BigEndian" ? Form::big_endian : Form::little_endian);
    if (binary ? bytes.size() / type.bytes != count || bytes.size() % type.bytes != 0
               : count > array.text.size() / 2 + 1)
        in.fail(array.line, "the array " + std::string(name) + " has no room for, or more than, " +
                                std::to_string(count) + " numbers");
    for (std::size_t k = 0; k < count; ++k)
        work(values, type.bytes);
    if (!binary)
        if (const std::string_view more = values.words().any_word(); !more.empty())
            values.fail("there is " + scene_file::quoted(more) + " behind the " + std::to_string(count) +
                        " numbers of the array " + std::string(name));
}

void need(const Context& in, const VtuPiece& piece, const VtuArray& array, std::string_view name)
{
    if (!array.found)
        in.fail(piece.line, "the piece has no array " + std::string(name));
}

std::vector<std::int64_t> read_whole(const Context& in, const VtuPiece& piece, const VtuArray& array,
                                     std::string_view name, std::size_t count)
{
    need(in, piece, array, name);
    std::vector<std::int64_t> out;
    read_array(in, array, name, type_of(in, array, name, true), count,
               [&](Values& values, std::size_t bytes) { out.push_back(values.integer(bytes, name)); });
    return out;
}

void read_points(const Context& in, const VtuPiece& piece, std::size_t count, std::vector<glm::dvec3>& points)
{
    const VtuArray& array = piece.positions;
    need(in, piece, array, "of points");
    if (array.components != "3")
        in.fail(array.line,
                "points have " + scene_file::quoted(array.components) + " components; they must have 3");
    if (count > array.text.size())
        in.fail(piece.line, "NumberOfPoints is " + piece.points + ", more than the array of points holds");
    std::vector<double> flat;
    read_array(
        in, array, "of points", type_of(in, array, "of points", false), 3 * count,
        [&](Values& values, std::size_t bytes) { flat.push_back(values.number(bytes, "a coordinate")); });
    for (std::size_t v = 0; v < count; ++v)
        points.emplace_back(flat[3 * v], flat[3 * v + 1], flat[3 * v + 2]);
}

/// `first`: number of the piece's first point among all points; it has `points` of its own.
void read_connectivity(const Context& in, const VtuPiece& piece, std::size_t count, std::size_t first,
                       std::size_t points, VtkCells& cells)
{
    for (const std::int64_t corner : read_whole(in, piece, piece.connectivity, "connectivity", count))
    {
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= points)
            in.fail(piece.connectivity.line, "a cell names point " + std::to_string(corner) +
                                                 "; the piece has " + std::to_string(points) +
                                                 ", numbered from 0");
        cells.connectivity.push_back(static_cast<std::int64_t>(first) + corner);
    }
}

/// Adds a piece behind those before it.
void read_piece(const Context& in, const VtuPiece& piece, std::vector<glm::dvec3>& points, VtkCells& cells)
{
    const std::size_t count = to_count(in, piece.line, piece.points, "NumberOfPoints");
    const std::size_t cell_count = to_count(in, piece.line, piece.cells, "NumberOfCells");
    if (count == 0 && cell_count == 0)
        return;
    const std::size_t first = points.size(), before = cells.connectivity.size();
    read_points(in, piece, count, points);
    const auto ends = read_whole(in, piece, piece.offsets, "offsets", cell_count);
    const auto types = read_whole(in, piece, piece.types, "types", cell_count);
    const std::int64_t last = ends.empty() ? 0 : ends.back();
    for (const std::int64_t end : ends)
    {
        if (end < 0 || end > last)
            in.fail(piece.offsets.line, "an offset is " + std::to_string(end) +
                                            "; offsets must be 0 or more and rise to the last, " +
                                            std::to_string(last));
        cells.ends.push_back(static_cast<std::int64_t>(before) + end);
    }
    read_connectivity(in, piece, static_cast<std::size_t>(last), first, count, cells);
    cells.types.insert(cells.types.end(), types.begin(), types.end());
}

} // namespace

RawSolid read_vtu(std::string_view text, const std::string& file)
{
    const VtuText xml = read_vtu_text(text, file);
    const Context in{file, xml};
    if (xml.type != "UnstructuredGrid")
        in.fail(1,
                "the type of the file is " + scene_file::quoted(xml.type) + "; it must be UnstructuredGrid");
    std::vector<glm::dvec3> points;
    VtkCells cells;
    for (const VtuPiece& piece : xml.pieces)
        read_piece(in, piece, points, cells);
    SolidBuilder solid;
    if (const std::string wrong = add_vtk_cells(points, cells, solid); !wrong.empty())
        throw Error(ErrorCode::bad_input, file + ": " + wrong);
    return solid.take();
}

} // namespace taut::scene_file
