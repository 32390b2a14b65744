// PLY, text and binary of both byte orders: x, y, z of the element `vertex`, the corner list of `face`.

#include "taut/scene/checker.hpp"
#include "taut/scene/ply_values.hpp"
#include "taut/scene/raw_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::scene_file {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

std::size_t property_named(const PlyElement& element, std::string_view name)
{
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name)
            return i;
    return kNone;
}

void read_vertices(PlyValues& values, const PlyElement& element, RawMesh& mesh)
{
    const std::array<std::size_t, 3> at = {property_named(element, "x"), property_named(element, "y"),
                                           property_named(element, "z")};
    for (const std::size_t i : at)
        if (i == kNone || element.properties[i].list)
            values.fail("the element \"vertex\" must have the numbers x, y and z");
    mesh.positions.reserve(element.count);
    for (std::size_t v = 0; v < element.count; ++v)
    {
        glm::dvec3 p(0);
        for (std::size_t i = 0; i < element.properties.size(); ++i)
        {
            const PlyProperty& property = element.properties[i];
            const auto which = std::find(at.begin(), at.end(), i);
            if (which == at.end())
                values.skip(property);
            else
                p[static_cast<int>(which - at.begin())] = values.value(property.type);
        }
        if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
            values.fail("vertex " + std::to_string(v) +
                        " has a coordinate that is not finite; every number must be");
        mesh.positions.push_back(p);
    }
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

void read_faces(PlyValues& values, const PlyElement& element, RawMesh& mesh)
{
    std::size_t list = property_named(element, "vertex_indices");
    if (list == kNone)
        list = property_named(element, "vertex_index");
    if (list == kNone || !element.properties[list].list)
        values.fail("the element \"face\" must have the list vertex_indices");
    std::vector<std::uint32_t> corners;
    mesh.triangles.reserve(element.count);
    for (std::size_t f = 0; f < element.count; ++f)
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            if (i != list)
                values.skip(element.properties[i]);
            else
            {
                read_corners(values, element.properties[i], mesh.positions.size(), corners);
                add_face(mesh, corners);
            }
}

} // namespace

RawMesh read_ply(std::string_view text, const std::string& file)
{
    const PlyHeader header = read_ply_header(text, file);
    PlyValues values(text.substr(header.bytes), file, header.format);
    RawMesh mesh;
    for (const PlyElement& element : header.elements)
    {
        values.expect_room(element);
        if (element.name == "vertex")
            read_vertices(values, element, mesh);
        else if (element.name == "face")
            read_faces(values, element, mesh);
        else
            for (std::size_t n = 0; n < element.count && !element.properties.empty(); ++n)
                for (const PlyProperty& property : element.properties)
                    values.skip(property);
    }
    return mesh;
}

} // namespace taut::scene_file
