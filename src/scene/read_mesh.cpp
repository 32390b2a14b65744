// Mesh files: the format by the file's extension, its text, its mesh.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/mesh.hpp"
#include "taut/scene/weld.hpp"

#include <algorithm>
#include <cmath>

namespace taut {

namespace scene_file {

namespace {

using SurfaceReader = RawMesh (*)(std::string_view, const std::string&);

SurfaceReader reader_of(std::string extension, const std::string& file)
{
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    if (extension == ".obj")
        return read_obj;
    if (extension == ".off")
        return read_off;
    if (extension == ".ply")
        return read_ply;
    if (extension == ".stl")
        return read_stl;
    throw Error(ErrorCode::bad_input, file + ": the extension \"" + extension +
                                          "\" is not read; it must be .obj, .ply, .off or .stl");
}

RawMesh parse_raw(std::string_view text, std::string extension, const std::string& file)
{
    RawMesh raw = reader_of(std::move(extension), file)(text, file);
    check_coordinates(raw.positions, file);
    return raw;
}

// Vertices have 32-bit numbers, and a file needs more than a byte for each.
constexpr std::uintmax_t kMaxMeshBytes = std::uintmax_t(1) << 32;

} // namespace

void check_coordinates(std::span<const glm::dvec3> positions, const std::string& file)
{
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(positions[v][c]) <= kMaxValue))
                throw Error(ErrorCode::bad_input, file + ": vertex " + std::to_string(v) + " is " +
                                                      shown(positions[v]) +
                                                      "; coordinates must be at most 1e30 in magnitude");
}

RawMesh read_raw_mesh(const std::filesystem::path& file)
{
    return parse_raw(read_file(file, kMaxMeshBytes), file.extension().string(), file.string());
}

Mesh parse_mesh(std::string_view text, std::string extension, const std::string& file, double weld_distance,
                MeshFindings& findings)
{
    const RawMesh raw = parse_raw(text, std::move(extension), file);
    findings = {};
    Mesh mesh = clean(raw, weld_distance, findings);
    findings.skipped = raw.skipped;
    if (mesh.triangles.empty())
        throw Error(ErrorCode::bad_input,
                    file + ": it has " + std::to_string(raw.positions.size()) +
                        " vertices and no triangle with area; there is nothing to simulate");
    return mesh;
}

} // namespace scene_file

std::vector<std::string> skipped_texts(const std::map<std::string, std::size_t>& skipped)
{
    std::vector<std::string> texts;
    for (const auto& [word, lines] : skipped)
        texts.push_back("has " + std::to_string(lines) + (lines == 1 ? " line " : " lines ") + word +
                        (lines == 1 ? ", which is not read" : ", which are not read"));
    return texts;
}

Mesh read_mesh(const std::filesystem::path& file, double weld_distance, MeshFindings* findings)
{
    MeshFindings found;
    Mesh mesh = scene_file::parse_mesh(scene_file::read_file(file, scene_file::kMaxMeshBytes),
                                       file.extension().string(), file.string(), weld_distance, found);
    if (findings)
        *findings = std::move(found);
    return mesh;
}

} // namespace taut
