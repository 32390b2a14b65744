// OBJ files, written fast: a simulation writes hundreds of them.

#include "taut/scene/file_text.hpp"
#include "taut/scene/mesh.hpp"

#include <charconv>
#include <string>

namespace taut {

namespace {

/// As printf("%.9g"): enough to give back every float.
void append(std::string& out, double value)
{
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr;
    out.append(digits, end);
}

void append(std::string& out, std::uint32_t value)
{
    char digits[16];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <std::size_t N>
void append_element(std::string& out, char keyword, const std::array<std::uint32_t, N>& corners)
{
    out += keyword;
    for (const std::uint32_t corner : corners)
    {
        out += ' ';
        append(out, corner + 1);
    }
    out += '\n';
}

} // namespace

void write_obj(const std::filesystem::path& file, const Mesh& mesh)
{
    std::string text;
    text.reserve(48 * mesh.positions.size() + 24 * mesh.triangles.size());
    for (const glm::dvec3& p : mesh.positions)
    {
        text += 'v';
        for (int c = 0; c < 3; ++c)
        {
            text += ' ';
            append(text, p[c]);
        }
        text += '\n';
    }
    for (const auto& triangle : mesh.triangles)
        append_element(text, 'f', triangle);
    for (const auto& link : mesh.links)
        append_element(text, 'l', link);
    scene_file::write_file(file, text);
}

} // namespace taut
