// Files of tetrahedra: the format by the file's extension, its text, its mesh.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/raw_solid.hpp"

#include <cmath>

namespace taut {

namespace scene_file {
namespace {

using SolidReader = RawSolid (*)(std::string_view, const std::string&);

struct Format
{
    std::string_view extension;
    SolidReader read;
};
constexpr Format kFormats[] = {
    {".msh", read_gmsh}, {".vtk", read_vtk}, {".vtu", read_vtu}, {".mesh", read_medit}};

std::string lower(std::string text)
{
    for (char& c : text)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// Squares and cubes of coordinates must stay finite.
Mesh to_mesh(RawSolid raw, const std::string& file, MeshFindings& findings)
{
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

/// The other file of a TetGen pair, its extension spelt as that of the one that was named.
std::filesystem::path partner(const std::filesystem::path& file, std::string_view extension)
{
    const std::string named = file.extension().string();
    const bool upper = named.size() > 1 && named[1] >= 'A' && named[1] <= 'Z';
    std::string other;
    for (const char c : extension)
        other += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::filesystem::path out = file;
    out.replace_extension(other);
    std::error_code ignored;
    if (!std::filesystem::exists(out, ignored))
        throw Error(ErrorCode::io,
                    file.string() + ": there is no " + out.string() +
                        " beside it; TetGen's vertices (.node) and tetrahedra (.ele) are two files");
    return out;
}

Mesh read_pair(const std::filesystem::path& file, bool node_named, std::uintmax_t max_bytes,
               MeshFindings& findings)
{
    const std::string named = read_file(file, max_bytes);
    const std::filesystem::path beside = partner(file, node_named ? ".ele" : ".node");
    const std::string other = read_file(beside, max_bytes);
    const std::string named_file = file.string(), other_file = beside.string();
    return node_named ? parse_tetgen({named, named_file}, {other, other_file}, findings)
                      : parse_tetgen({other, other_file}, {named, named_file}, findings);
}

} // namespace

Mesh parse_tetgen(const NamedText& node, const NamedText& ele, MeshFindings& findings)
{
    return to_mesh(read_tetgen(node, ele), ele.file, findings);
}

Mesh parse_tetrahedra(std::string_view text, std::string extension, const std::string& file,
                      MeshFindings& findings)
{
    for (const Format& format : kFormats)
        if (format.extension == lower(extension))
            return to_mesh(format.read(text, file), file, findings);
    throw Error(ErrorCode::bad_input, file + ": the extension \"" + extension +
                                          "\" is not read; it must be .node or .ele (TetGen), .msh (Gmsh), "
                                          ".vtk, .vtu or .mesh (Medit)");
}

} // namespace scene_file

Mesh read_tetrahedra(const std::filesystem::path& file, MeshFindings* findings)
{
    constexpr std::uintmax_t max_bytes = std::uintmax_t(1) << 32; // as read_mesh
    const std::string extension = scene_file::lower(file.extension().string());
    MeshFindings found;
    Mesh mesh;
    if (extension == ".node" || extension == ".ele")
        mesh = scene_file::read_pair(file, extension == ".node", max_bytes, found);
    else
        mesh = scene_file::parse_tetrahedra(scene_file::read_file(file, max_bytes), extension, file.string(),
                                            found);
    if (findings)
        *findings = std::move(found);
    return mesh;
}

} // namespace taut
