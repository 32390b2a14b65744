// PLY, text and binary of both byte orders: x, y, z and texture coordinates of the element `vertex`, the
// corner list of `face` and its list of texture coordinates.

#include "taut/scene/checker.hpp"
#include "taut/scene/ply_values.hpp"
#include "taut/scene/raw_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::scene_file {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
const std::array<glm::dvec2, 3> kNoTextureAtAll = {glm::dvec2(kNoTexture), glm::dvec2(kNoTexture),
                                                   glm::dvec2(kNoTexture)};

std::size_t property_named(const PlyElement& element, std::string_view name)
{
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name)
            return i;
    return kNone;
}

/// Where a vertex has texture coordinates, under the names that exporters give them; kNone where it has none.
std::array<std::size_t, 2> texture_properties(const PlyElement& element)
{
    constexpr std::array<std::array<std::string_view, 2>, 3> names = {
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}};
    for (const auto& [u, v] : names)
    {
        const std::array<std::size_t, 2> at = {property_named(element, u), property_named(element, v)};
        if (at[0] != kNone && at[1] != kNone && !element.properties[at[0]].list &&
            !element.properties[at[1]].list)
            return at;
    }
    return {kNone, kNone};
}

/// `texture`: one for each vertex, or none.
void read_vertices(PlyValues& values, const PlyElement& element, RawMesh& mesh,
                   std::vector<glm::dvec2>& texture)
{
    const std::array<std::size_t, 2> uv = texture_properties(element);
    const std::array<std::size_t, 3> at = {property_named(element, "x"), property_named(element, "y"),
                                           property_named(element, "z")};
    for (const std::size_t i : at)
        if (i == kNone || element.properties[i].list)
            values.fail("the element \"vertex\" must have the numbers x, y and z");
    mesh.positions.reserve(element.count);
    if (uv[0] != kNone) // vertices of an element before this one have none
        texture.resize(mesh.positions.size(), glm::dvec2(kNoTexture));
    for (std::size_t v = 0; v < element.count; ++v)
    {
        glm::dvec3 p(0);
        glm::dvec2 t(0);
        for (std::size_t i = 0; i < element.properties.size(); ++i)
        {
            const PlyProperty& property = element.properties[i];
            const auto which = std::find(at.begin(), at.end(), i);
            const auto of_texture = std::find(uv.begin(), uv.end(), i);
            if (which != at.end())
                p[static_cast<int>(which - at.begin())] = values.value(property.type);
            else if (of_texture != uv.end())
                t[static_cast<int>(of_texture - uv.begin())] = values.value(property.type);
            else
                values.skip(property);
        }
        if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
            values.fail("vertex " + std::to_string(v) +
                        " has a coordinate that is not finite; every number must be");
        mesh.positions.push_back(p);
        if (uv[0] != kNone)
            texture.push_back(t);
    }
    if (!texture.empty())
        texture.resize(mesh.positions.size(), glm::dvec2(kNoTexture));
}

void read_corners(PlyValues& values, const PlyProperty& property, std::size_t vertex_count,
                  std::vector<std::uint32_t>& corners)
{
    const std::size_t count = values.list_size(property);
    if (count < 3)
        values.fail("a face has " + std::to_string(count) + " corners; it needs 3 or more");
    corners.clear();
    for (std::size_t i = 0; i < count; ++i)
    {
        const double index = values.value(property.type);
        if (!(index >= 0 && index < double(vertex_count) && index == std::floor(index)))
            values.fail("a face names vertex " + shown(index) + "; the file has " +
                        std::to_string(vertex_count) + " before it, numbered from 0");
        corners.push_back(static_cast<std::uint32_t>(index));
    }
}

/// Of a face: two numbers for each of its corners; anything else is as none.
void read_texture(PlyValues& values, const PlyProperty& property, std::vector<glm::dvec2>& corners)
{
    const std::size_t count = values.list_size(property);
    corners.assign(count / 2, glm::dvec2(kNoTexture));
    for (std::size_t i = 0; i < count; ++i)
    {
        const double value = values.value(property.type);
        if (i / 2 < corners.size())
            corners[i / 2][static_cast<int>(i % 2)] = value;
    }
}

void add_face_texture(const std::vector<std::uint32_t>& corners, const std::vector<glm::dvec2>& of_vertices,
                      const std::vector<glm::dvec2>& of_corners, RawMesh& mesh)
{
    const auto at = [&](std::size_t i) {
        if (of_corners.size() == corners.size())
            return of_corners[i];
        return of_vertices.empty() ? glm::dvec2(kNoTexture) : of_vertices[corners[i]];
    };
    for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.texture.push_back({at(0), at(i - 1), at(i)});
}

void read_faces(PlyValues& values, const PlyElement& element, RawMesh& mesh,
                const std::vector<glm::dvec2>& texture)
{
    std::size_t list = property_named(element, "vertex_indices");
    if (list == kNone)
        list = property_named(element, "vertex_index");
    if (list == kNone || !element.properties[list].list)
        values.fail("the element \"face\" must have the list vertex_indices");
    std::size_t uv = property_named(element, "texcoord");
    if (uv != kNone && !element.properties[uv].list)
        uv = kNone;
    std::vector<std::uint32_t> corners;
    std::vector<glm::dvec2> corner_texture;
    mesh.triangles.reserve(element.count);
    for (std::size_t f = 0; f < element.count; ++f)
    {
        corner_texture.clear();
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            if (i == list)
                read_corners(values, element.properties[i], mesh.positions.size(), corners);
            else if (i == uv)
                read_texture(values, element.properties[i], corner_texture);
            else
                values.skip(element.properties[i]);
        if (uv != kNone || !texture.empty())
        {
            mesh.texture.resize(mesh.triangles.size(), kNoTextureAtAll);
            add_face_texture(corners, texture, corner_texture, mesh);
        }
        add_face(mesh, corners);
    }
    if (!mesh.texture.empty())
        mesh.texture.resize(mesh.triangles.size(), kNoTextureAtAll);
}

} // namespace

RawMesh read_ply(std::string_view text, const std::string& file)
{
    const PlyHeader header = read_ply_header(text, file);
    PlyValues values(text.substr(header.bytes), file, header.format);
    RawMesh mesh;
    std::vector<glm::dvec2> texture;
    for (const PlyElement& element : header.elements)
    {
        values.expect_room(element);
        if (element.name == "vertex")
            read_vertices(values, element, mesh, texture);
        else if (element.name == "face")
            read_faces(values, element, mesh, texture);
        else
            for (std::size_t n = 0; n < element.count && !element.properties.empty(); ++n)
                for (const PlyProperty& property : element.properties)
                    values.skip(property);
    }
    return mesh;
}

} // namespace taut::scene_file
