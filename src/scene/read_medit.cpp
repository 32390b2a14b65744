// Medit (.mesh) text files: vertices and tetrahedra; other elements are passed over.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/raw_solid.hpp"
#include "taut/scene/words.hpp"

#include <algorithm>
#include <array>

namespace taut::scene_file {
namespace {

/// Sections that are passed over, with the numbers of an entry.
struct MeditSection
{
    std::string_view name;
    int numbers;
};
constexpr MeditSection kPassed[] = {{"Edges", 3},
                                    {"Triangles", 4},
                                    {"Quadrilaterals", 5},
                                    {"Hexahedra", 9},
                                    {"Corners", 1},
                                    {"RequiredVertices", 1},
                                    {"Ridges", 1},
                                    {"RequiredEdges", 1},
                                    {"RequiredTriangles", 1},
                                    {"Normals", 3},
                                    {"NormalAtVertices", 2},
                                    {"Tangents", 3},
                                    {"TangentAtVertices", 2}};

std::size_t count_of(Words& words, std::string_view section)
{
    const std::int64_t count = words.to_integer(words.any_word(), std::string(section) + " count");
    // Every entry takes at least two bytes of text; more cannot be there.
    if (count < 0 || static_cast<std::uint64_t>(count) > words.left() / 2 + 1)
        words.fail("the section " + std::string(section) + " announces " + std::to_string(count) +
                   " entries, more than the file holds");
    return static_cast<std::size_t>(count);
}

void read_vertices(Words& words, RawSolid& out)
{
    const std::size_t count = count_of(words, "Vertices");
    for (std::size_t v = 0; v < count; ++v)
    {
        glm::dvec3 p;
        for (int c = 0; c < 3; ++c)
            p[c] = words.to_number(words.any_word(), "coordinate");
        words.to_number(words.any_word(), "reference of a vertex");
        out.positions.push_back(p);
    }
}

void read_tetrahedra(Words& words, RawSolid& out)
{
    const std::size_t count = count_of(words, "Tetrahedra"), vertices = out.positions.size();
    for (std::size_t t = 0; t < count; ++t)
    {
        std::array<std::uint32_t, 4> corners{};
        for (std::uint32_t& corner : corners)
        {
            const std::int64_t number = words.to_integer(words.any_word(), "corner of a tetrahedron");
            if (number < 1 || static_cast<std::uint64_t>(number) > vertices)
                words.fail("tetrahedron " + std::to_string(t + 1) + " names vertex " +
                           std::to_string(number) + "; there are " + std::to_string(vertices) +
                           ", numbered from 1");
            corner = static_cast<std::uint32_t>(number - 1);
        }
        words.to_number(words.any_word(), "reference of a tetrahedron");
        std::array<std::uint32_t, 4> sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            words.fail("tetrahedron " + std::to_string(t + 1) + " names a vertex twice");
        out.tetrahedra.push_back(corners);
    }
}

} // namespace

RawSolid read_medit(std::string_view text, const std::string& file)
{
    Words words(text, file);
    RawSolid out;
    for (std::string_view word = words.any_word(); !word.empty() && word != "End"; word = words.any_word())
    {
        const auto passed = std::find_if(std::begin(kPassed), std::end(kPassed),
                                         [&](const MeditSection& s) { return s.name == word; });
        if (word == "MeshVersionFormatted")
            words.to_integer(words.any_word(), "version");
        else if (word == "Dimension")
        {
            if (words.to_integer(words.any_word(), "dimension") != 3)
                words.fail("the dimension must be 3");
        }
        else if (word == "Vertices")
            read_vertices(words, out);
        else if (word == "Tetrahedra")
            read_tetrahedra(words, out);
        else if (passed != std::end(kPassed))
            for (std::size_t left = count_of(words, word) * static_cast<std::size_t>(passed->numbers);
                 left > 0; --left)
                words.to_number(words.any_word(), "number of a passed section");
        else
            words.fail("the section " + quoted(word) + " is not known; Vertices and Tetrahedra are read");
    }
    return out;
}

} // namespace taut::scene_file
