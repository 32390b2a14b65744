// OFF text: OFF, and COFF, NOFF, CNOFF, STOFF whose further numbers are skipped.

#include "taut/scene/raw_mesh.hpp"
#include "taut/scene/words.hpp"

#include <algorithm>
#include <array>

namespace taut::scene_file {

namespace {

/// A count that the rest of the file has room for.
std::size_t read_count(Words& words, std::string_view what, std::size_t bytes_each)
{
    const std::int64_t count = words.integer(what);
    if (count < 0 || static_cast<std::uint64_t>(count) > words.left() / bytes_each)
        words.fail(std::string(what) + " is " + std::to_string(count) + "; the " +
                   std::to_string(words.left()) + " bytes that follow have no room for so many");
    return static_cast<std::size_t>(count);
}

void read_face(Words& words, RawMesh& mesh, std::vector<std::uint32_t>& corners)
{
    const std::int64_t corner_count = words.integer("the number of corners of a face");
    if (corner_count < 3 || static_cast<std::uint64_t>(corner_count) > words.left() / 2 + 1)
        words.fail("a face has " + std::to_string(corner_count) +
                   " corners; it needs 3 or more, all on this line");
    corners.clear();
    for (std::int64_t i = 0; i < corner_count; ++i)
    {
        const std::int64_t index = words.integer("a corner of a face");
        if (index < 0 || static_cast<std::uint64_t>(index) >= mesh.positions.size())
            words.fail("a face names vertex " + std::to_string(index) + "; the file has " +
                       std::to_string(mesh.positions.size()) + ", numbered from 0");
        corners.push_back(static_cast<std::uint32_t>(index));
    }
    add_face(mesh, corners);
}

} // namespace

RawMesh read_off(std::string_view text, const std::string& file)
{
    constexpr std::array<std::string_view, 6> headers = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"};
    Words words(text, file);
    words.next_line();
    const std::string_view header = words.word();
    if (std::find(headers.begin(), headers.end(), header) == headers.end())
        words.fail("the file starts with " + quoted(header) + "; an OFF file starts with OFF");
    std::string_view first = words.word();
    if (first == "BINARY")
        words.fail("the file is binary OFF; convert it to text OFF");
    if (first.empty() && words.next_line())
        first = words.word();
    const std::int64_t vertices = words.to_integer(first, "the number of vertices");
    const std::size_t bytes_per_vertex = 6, bytes_per_face = 8; // "0 0 0\n", "3 0 0 0\n"
    if (vertices < 0 || static_cast<std::uint64_t>(vertices) > words.left() / bytes_per_vertex)
        words.fail("the number of vertices is " + std::to_string(vertices) + "; the " +
                   std::to_string(words.left()) + " bytes that follow have no room for so many");
    const std::size_t faces = read_count(words, "the number of faces", bytes_per_face);

    RawMesh mesh;
    mesh.positions.reserve(static_cast<std::size_t>(vertices));
    while (mesh.positions.size() < static_cast<std::size_t>(vertices))
    {
        if (!words.next_line())
            words.fail("the file ends after " + std::to_string(mesh.positions.size()) + " of " +
                       std::to_string(vertices) + " vertices");
        mesh.positions.push_back(words.position());
    }
    mesh.triangles.reserve(faces);
    std::vector<std::uint32_t> corners;
    for (std::size_t face = 0; face < faces; ++face)
    {
        if (!words.next_line())
            words.fail("the file ends after " + std::to_string(face) + " of " + std::to_string(faces) +
                       " faces");
        read_face(words, mesh, corners);
    }
    return mesh;
}

} // namespace taut::scene_file
