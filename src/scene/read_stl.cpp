// STL, text and binary. Each triangle carries its own three corners: welding makes it a mesh.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/raw_mesh.hpp"
#include "taut/scene/words.hpp"

#include <bit>
#include <cmath>

namespace taut::scene_file {

namespace {

constexpr std::size_t kHeaderBytes = 80, kTriangleBytes = 50;

std::uint32_t little_endian(std::string_view text, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t b = 0; b < 4; ++b)
        value |= std::uint32_t(static_cast<unsigned char>(text[at + b])) << (8 * b);
    return value;
}

void add_corner(RawMesh& mesh, const glm::dvec3& position)
{
    mesh.positions.push_back(position);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    if (count % 3 == 0)
        mesh.triangles.push_back({count - 3, count - 2, count - 1});
}

RawMesh read_binary(std::string_view text, const std::string& file)
{
    const auto fail = [&](const std::string& what) { throw Error(ErrorCode::bad_input, file + ": " + what); };
    if (text.size() < kHeaderBytes + 4)
        fail("it has " + std::to_string(text.size()) +
             " bytes; an STL file starts with \"solid\" or has 84 or more");
    const std::uint64_t count = little_endian(text, kHeaderBytes);
    if (count > (text.size() - kHeaderBytes - 4) / kTriangleBytes)
        fail("byte 80 announces " + std::to_string(count) + " triangles; the " + std::to_string(text.size()) +
             " bytes of the file have no room for so many");
    RawMesh mesh;
    mesh.triangles.reserve(count);
    mesh.positions.reserve(3 * count);
    for (std::size_t t = 0; t < count; ++t)
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
            const std::size_t at = kHeaderBytes + 4 + t * kTriangleBytes + 12 + 12 * corner;
            glm::dvec3 p;
            for (std::size_t c = 0; c < 3; ++c)
                p[static_cast<int>(c)] = std::bit_cast<float>(little_endian(text, at + 4 * c));
            if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
                fail("triangle " + std::to_string(t) +
                     " has a corner that is not finite; every number must be");
            add_corner(mesh, p);
        }
    return mesh;
}

/// The next word, which must be this one.
void expect(Words& words, std::string_view keyword)
{
    const std::string_view found = words.any_word();
    if (found != keyword)
        words.fail("there is " + quoted(found) + " where \"" + std::string(keyword) + "\" must stand");
}

glm::dvec3 any_position(Words& words)
{
    glm::dvec3 p;
    for (int c = 0; c < 3; ++c)
        p[c] = words.to_number(words.any_word(), "a coordinate");
    return p;
}

/// "outer loop" to "endfacet"; exporters write the normal of a degenerate facet as nan, so it is skipped.
void read_facet(Words& words, RawMesh& mesh)
{
    expect(words, "normal");
    for (int c = 0; c < 3; ++c)
        words.any_word();
    expect(words, "outer");
    expect(words, "loop");
    for (int corner = 0; corner < 3; ++corner)
    {
        expect(words, "vertex");
        add_corner(mesh, any_position(words));
    }
    expect(words, "endloop");
    expect(words, "endfacet");
}

RawMesh read_text(std::string_view text, const std::string& file)
{
    RawMesh mesh;
    Words words(text, file);
    words.set_comment('\0');
    while (words.next_line()) // a file may hold several solids
    {
        if (const std::string_view first = words.word(); first != "solid")
            words.fail("there is " + quoted(first) + " where \"solid\" must stand");
        while (!words.word().empty()) // the name
        {}
        std::string_view word = words.any_word();
        for (; word == "facet"; word = words.any_word())
            read_facet(words, mesh);
        if (word != "endsolid")
            words.fail("there is " + quoted(word) + " where \"facet\" or \"endsolid\" must stand");
    }
    return mesh;
}

} // namespace

RawMesh read_stl(std::string_view text, const std::string& file)
{
    // Binary files may start with "solid" too; theirs is the only length that fits the count exactly.
    const bool exact =
        text.size() >= kHeaderBytes + 4 &&
        text.size() == kHeaderBytes + 4 + std::uint64_t(little_endian(text, kHeaderBytes)) * kTriangleBytes;
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    const bool solid = start != std::string_view::npos && text.substr(start).starts_with("solid");
    return solid && !exact ? read_text(text, file) : read_binary(text, file);
}

} // namespace taut::scene_file
