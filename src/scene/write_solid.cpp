#include "taut/scene/write_solid.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

namespace taut {
namespace {

/// Numbered from 1, each line with the reference 0.
template <std::size_t N>
void append_elements(std::string& text, const char* name,
                     const std::vector<std::array<std::uint32_t, N>>& all)
{
    text += std::string(name) + "\n" + std::to_string(all.size()) + "\n";
    for (const auto& corners : all)
    {
        for (const std::uint32_t corner : corners)
            text += std::to_string(std::uint64_t(corner) + 1) + " ";
        text += "0\n";
    }
}

} // namespace

void write_medit(const std::filesystem::path& file, const Mesh& solid)
{
    std::string text =
        "MeshVersionFormatted 2\nDimension 3\nVertices\n" + std::to_string(solid.positions.size()) + "\n";
    for (const glm::dvec3& p : solid.positions)
        text += shown(p.x) + " " + shown(p.y) + " " + shown(p.z) + " 0\n";
    append_elements(text, "Triangles", solid.triangles);
    append_elements(text, "Tetrahedra", solid.tetrahedra);
    write_file(file, text + "End\n");
}

} // namespace taut
