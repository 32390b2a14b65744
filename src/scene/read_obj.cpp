// Wavefront OBJ: vertices, faces and their texture coordinates, by which a fabric may lie. Normals, groups
// and materials carry no cloth and are skipped; lines, points, curves and words that no standard knows (some
// garment tools write `stitch`) are skipped and counted.

#include "taut/scene/raw_mesh.hpp"
#include "taut/scene/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
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

/// Texture coordinates are asked for by few scenes: what is no number is as if it were not there, and is told
/// by whoever asks.
double texture_number(std::string_view word)
{
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool good = code == std::errc() && end == word.data() + word.size() && std::isfinite(value);
    return good ? value : kNoTexture;
}

/// "7/3" or "7/3/1": the number of the texture coordinates from 0; the largest number where there are none.
std::size_t texture_index(std::string_view word, std::size_t count)
{
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    const std::size_t slash = word.find('/');
    if (slash == std::string_view::npos)
        return none;
    const std::string_view number = word.substr(slash + 1, word.find('/', slash + 1) - slash - 1);
    std::int64_t index = 0;
    const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (code != std::errc() || end != number.data() + number.size() || index == 0)
        return none;
    return static_cast<std::size_t>(index > 0 ? index - 1 : static_cast<std::int64_t>(count) + index);
}

/// Texture coordinates, and the numbers of each triangle's corners: a face may name what follows it.
struct Texture
{
    std::vector<glm::dvec2> points;
    std::vector<std::array<std::size_t, 3>> triangles;

    void add_face(std::span<const std::size_t> corners)
    {
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }

    void add_to(RawMesh& mesh) const
    {
        const auto at = [&](std::size_t i) { return i < points.size() ? points[i] : glm::dvec2(kNoTexture); };
        for (const auto& t : triangles)
            mesh.texture.push_back({at(t[0]), at(t[1]), at(t[2])});
    }
};

/// What looks only, or names.
bool is_looks(std::string_view word)
{
    constexpr std::array<std::string_view, 16> words = {
        "vn",     "g",     "o",        "s",        "mg",  "usemtl",     "mtllib",    "usemap",
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
    std::vector<std::size_t> texture_corners;
    Texture texture;
    std::uint32_t largest = 0;
    while (words.next_line())
    {
        const std::string_view keyword = words.word();
        if (keyword == "v")
            mesh.positions.push_back(words.position());
        else if (keyword == "vt")
        {
            const double u = texture_number(words.word()), v = texture_number(words.word());
            texture.points.emplace_back(u, v);
        }
        else if (keyword != "f")
            count_skipped(keyword, mesh);
        if (keyword != "f")
            continue;
        corners.clear();
        texture_corners.clear();
        for (std::string_view word = words.word(); !word.empty(); word = words.word())
        {
            corners.push_back(corner_index(word, mesh.positions.size(), words));
            largest = std::max(largest, corners.back());
            texture_corners.push_back(texture_index(word, texture.points.size()));
        }
        if (corners.size() < 3)
            words.fail("a face has " + std::to_string(corners.size()) + " corners; it needs 3 or more");
        add_face(mesh, corners);
        texture.add_face(texture_corners);
    }
    // A face may name vertices that follow it, so the upper end is known only now.
    if (!mesh.triangles.empty() && largest >= mesh.positions.size())
        words.fail("a face names vertex " + std::to_string(std::uint64_t(largest) + 1) + "; the file has " +
                   std::to_string(mesh.positions.size()) + ", numbered from 1");
    if (!texture.points.empty())
        texture.add_to(mesh);
    return mesh;
}

} // namespace taut::scene_file
