#include "taut/cli/mesh_sequence.hpp"

#include "taut/cli/output.hpp"

#include <charconv>
#include <cstdio>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

/// OBJ names end at white space.
std::string object_name(const Body& body, std::size_t index)
{
    std::string name = body.name.empty() ? "body_" + std::to_string(index) : body.name;
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= ' ')
            c = '_';
    return name;
}

std::string faces_text(const Mesh& mesh, std::size_t first_vertex)
{
    std::string text;
    const auto append = [&](std::uint32_t vertex) {
        text += ' ';
        text += std::to_string(first_vertex + vertex + 1);
    };
    for (const auto& triangle : mesh.triangles)
    {
        text += 'f';
        for (const std::uint32_t vertex : triangle)
            append(vertex);
        text += '\n';
    }
    for (const auto& link : mesh.links)
    {
        text += 'l';
        for (const std::uint32_t vertex : link)
            append(vertex);
        text += '\n';
    }
    return text;
}

void append_number(std::string& text, double value)
{
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr;
    text.append(digits, end);
}

} // namespace

MeshSequence::MeshSequence(const Scene& resolved, fs::path folder) : folder_(std::move(folder))
{
    std::size_t first = 0;
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Mesh& mesh = resolved.bodies[b].mesh;
        faces_.push_back("o " + object_name(resolved.bodies[b], b) + "\n" + faces_text(mesh, first));
        vertices_.push_back(mesh.positions.size());
        first += mesh.positions.size();
    }
}

fs::path MeshSequence::file_name(std::size_t index) const
{
    char name[32];
    std::snprintf(name, sizeof name, "mesh_%05zu.obj", index);
    return folder_ / name;
}

void MeshSequence::write(const std::vector<glm::dvec3>& positions, std::uint64_t frame, double time)
{
    std::string text =
        "# taut, frame " + std::to_string(frame) + ", time " + number(time, 9) + " s, metres\n";
    text.reserve(positions.size() * 40);
    std::size_t vertex = 0;
    for (std::size_t body = 0; body < faces_.size(); ++body)
    {
        const std::size_t name_end = faces_[body].find('\n') + 1;
        text.append(faces_[body], 0, name_end);
        for (const std::size_t end = vertex + vertices_[body]; vertex < end; ++vertex)
        {
            text += "v";
            for (int axis = 0; axis < 3; ++axis)
            {
                text += " ";
                append_number(text, positions[vertex][axis]);
            }
            text += "\n";
        }
        text.append(faces_[body], name_end);
    }
    write_file(file_name(count_), text);
    ++count_;
}

void MeshSequence::remove_older() const
{
    std::error_code ignored;
    for (std::size_t index = count_; fs::remove(file_name(index), ignored); ++index)
    {}
}

} // namespace taut::cli
