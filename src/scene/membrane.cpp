// Based on: the triangle of constant strain (Turner, Clough, Martin, Topp 1956), in coordinates of warp and
// weft. Departures: none.

#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace taut::scene_file {
namespace {

constexpr double kOneDegree = 0.0174524064372835; ///< its sine

std::array<glm::dvec3, 3> corners(const Mesh& mesh, std::size_t triangle)
{
    const auto& t = mesh.triangles[triangle];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

glm::dvec3 unit_normal(const std::array<glm::dvec3, 3>& x)
{
    return glm::normalize(glm::cross(x[1] - x[0], x[2] - x[0]));
}

bool stands_on(const glm::dvec3& grain, const std::array<glm::dvec3, 3>& x)
{
    const glm::dvec3 normal = unit_normal(x);
    return glm::length(grain - glm::dot(grain, normal) * normal) < kOneDegree * glm::length(grain);
}

} // namespace

std::array<double, 8> membrane_values(const std::array<glm::dvec3, 3>& x, const glm::dvec3& grain,
                                      const FabricMatrix& matrix)
{
    const glm::dvec3 e1 = x[1] - x[0], e2 = x[2] - x[0], normal = unit_normal(x);
    const glm::dvec3 warp = glm::normalize(grain - glm::dot(grain, normal) * normal);
    const glm::dvec3 weft = glm::cross(normal, warp);
    const double u1 = glm::dot(e1, warp), v1 = glm::dot(e1, weft);
    const double u2 = glm::dot(e2, warp), v2 = glm::dot(e2, weft);
    const double twice = u1 * v2 - u2 * v1, area = twice / 2;
    return {v2 / twice,        -u2 / twice,       -v1 / twice,       u1 / twice,
            matrix.c11 * area, matrix.c12 * area, matrix.c22 * area, matrix.c33 * area};
}

void add_membrane(Body& body, const Checker& out)
{
    const Fabric& fabric = body.material.fabric;
    const FabricMatrix matrix = fabric_matrix(fabric);
    const std::vector<Keyframe> turn = {
        {0, glm::dvec3(0), body.transform.rotate_axis, body.transform.rotate_degrees, glm::dvec3(0)}};
    const glm::dvec3 grain = pose(turn, 0, fabric.grain);
    Body::Elements list{kMembrane, {}, {}};
    for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t)
    {
        const std::array<glm::dvec3, 3> x = corners(body.mesh, t);
        if (stands_on(grain, x))
            return out.error("grain",
                             "is " + shown(fabric.grain) + ", which is within a degree of the normal of " +
                                 "triangle " + std::to_string(t) + " of the body (vertices " +
                                 std::to_string(body.mesh.triangles[t][0]) + ", " +
                                 std::to_string(body.mesh.triangles[t][1]) + ", " +
                                 std::to_string(body.mesh.triangles[t][2]) +
                                 "); give a direction that lies in no triangle's normal, in the frame "
                                 "of the shape");
        const std::array<double, 8> values = membrane_values(x, grain, matrix);
        list.vertices.insert(list.vertices.end(), body.mesh.triangles[t].begin(),
                             body.mesh.triangles[t].end());
        list.values.insert(list.values.end(), values.begin(), values.end());
    }
    body.elements.push_back(std::move(list));
}

} // namespace taut::scene_file
