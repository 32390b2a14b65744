// OBJ files, written fast: a simulation writes hundreds of them.

#include "taut/scene/obj_text.hpp"

#include <charconv>

namespace taut::scene_file {
namespace {

template <std::size_t N>
void append_element(std::string& text, char keyword, const std::array<std::uint32_t, N>& corners,
                    std::size_t first)
{
    text += keyword;
    for (const std::uint32_t corner : corners)
    {
        char digits[24];
        text += ' ';
        text.append(digits, std::to_chars(digits, digits + sizeof digits, first + corner + 1).ptr);
    }
    text += '\n';
}

} // namespace

void append_number(std::string& text, double value, int digits)
{
    char written[32];
    const auto end =
        std::to_chars(written, written + sizeof written, value, std::chars_format::general, digits).ptr;
    text.append(written, end);
}

void append_vertices(std::string& text, std::span<const glm::dvec3> positions, int digits)
{
    text.reserve(text.size() + 48 * positions.size());
    for (const glm::dvec3& p : positions)
    {
        text += 'v';
        for (int axis = 0; axis < 3; ++axis)
        {
            text += ' ';
            append_number(text, p[axis], digits);
        }
        text += '\n';
    }
}

void append_elements(std::string& text, const Mesh& mesh, std::size_t first)
{
    for (const auto& triangle : mesh.triangles)
        append_element(text, 'f', triangle, first);
    for (const auto& link : mesh.links)
        append_element(text, 'l', link, first);
}

} // namespace taut::scene_file
