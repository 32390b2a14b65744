// Files of tetrahedra: the format by the file's extension, its text, its mesh.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/raw_solid.hpp"

#include <cmath>

namespace taut {

namespace scene_file {

Mesh parse_tetrahedra(std::string_view text, std::string extension, const std::string& file,
                      MeshFindings& findings)
{
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    if (extension != ".mesh")
        throw Error(ErrorCode::bad_input,
                    file + ": the extension \"" + extension + "\" is not read; it must be .mesh");
    RawSolid raw = read_medit(text, file);
    for (std::size_t v = 0; v < raw.positions.size(); ++v)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(raw.positions[v][c]) <= kMaxValue))
                throw Error(ErrorCode::bad_input, file + ": vertex " + std::to_string(v) + " is " +
                                                      shown(raw.positions[v]) +
                                                      "; coordinates must be at most 1e30 in magnitude");
    if (raw.tetrahedra.empty())
        throw Error(ErrorCode::bad_input, file + ": it has " + std::to_string(raw.positions.size()) +
                                              " vertices and no tetrahedron; there is nothing to simulate");
    findings = {};
    return solid_mesh(std::move(raw.positions), std::move(raw.tetrahedra), file, findings);
}

} // namespace scene_file

Mesh read_tetrahedra(const std::filesystem::path& file, MeshFindings* findings)
{
    constexpr std::uintmax_t max_bytes = std::uintmax_t(1) << 32; // as read_mesh
    MeshFindings found;
    Mesh mesh = scene_file::parse_tetrahedra(scene_file::read_file(file, max_bytes), file.extension().string(),
                                             file.string(), found);
    if (findings)
        *findings = std::move(found);
    return mesh;
}

} // namespace taut
