// Wavefront OBJ: vertices and faces. Texture coordinates, normals, groups and materials carry no cloth and
// are skipped; lines, points, curves and words that no standard knows (some garment tools write `stitch`) are
// skipped and counted.

#include "taut/scene/raw_mesh.hpp"
#include "taut/scene/words.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace taut::scene_file {

namespace {

/// "7", "7/1", "7/1/3" or "7//3": the position's index, from 0. Negative counts back from the last vertex.
std::uint32_t corner_index(std::string_view word, std::size_t vertex_count, const Words& words)
{
    const std::int64_t index = words.to_integer(word.substr(0, word.find('/')), "a corner of a face");
    const auto count = static_cast<std::int64_t>(vertex_count);
    if (index < 0 && index >= -count)
        return static_cast<std::uint32_t>(count + index);
    if (index <= 0 || index > std::numeric_limits<std::uint32_t>::max())
        words.fail("a corner of a face is " + quoted(word) +
                   "; vertices are numbered from 1, or from -1 backwards" + ", and " +
                   std::to_string(vertex_count) + " stand before this line");
    return static_cast<std::uint32_t>(index - 1);
}

/// What looks only, or names.
bool is_looks(std::string_view word)
{
    constexpr std::array<std::string_view, 17> words = {
        "vt",     "vn",    "g",        "o",        "s",   "mg",         "usemtl",    "mtllib", "usemap",
        "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj", "ctech"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

void count_skipped(std::string_view word, RawMesh& mesh)
{
    constexpr std::size_t kMostKinds = 16; // a file that is no OBJ has a kind a line
    if (is_looks(word))
        return;
    const std::string shown = quoted(word);
    if (mesh.skipped.size() < kMostKinds || mesh.skipped.contains(shown))
        ++mesh.skipped[shown];
    else
        ++mesh.skipped["of further kinds"]; // "has 22 lines of further kinds"; no word stands without quotes
}

} // namespace

RawMesh read_obj(std::string_view text, const std::string& file)
{
    RawMesh mesh;
    Words words(text, file);
    words.join_lines();
    std::vector<std::uint32_t> corners;
    std::uint32_t largest = 0;
    while (words.next_line())
    {
        const std::string_view keyword = words.word();
        if (keyword == "v")
            mesh.positions.push_back(words.position());
        else if (keyword != "f")
            count_skipped(keyword, mesh);
        if (keyword != "f")
            continue;
        corners.clear();
        for (std::string_view word = words.word(); !word.empty(); word = words.word())
        {
            corners.push_back(corner_index(word, mesh.positions.size(), words));
            largest = std::max(largest, corners.back());
        }
        if (corners.size() < 3)
            words.fail("a face has " + std::to_string(corners.size()) + " corners; it needs 3 or more");
        add_face(mesh, corners);
    }
    // A face may name vertices that follow it, so the upper end is known only now.
    if (!mesh.triangles.empty() && largest >= mesh.positions.size())
        words.fail("a face names vertex " + std::to_string(std::uint64_t(largest) + 1) + "; the file has " +
                   std::to_string(mesh.positions.size()) + ", numbered from 1");
    return mesh;
}

} // namespace taut::scene_file
