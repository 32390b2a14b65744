// Based on: the triangle of constant strain (Turner, Clough, Martin, Topp 1956), in coordinates of warp and
// weft. Departures: none.

#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

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

std::vector<glm::dvec3> warp_directions(const Body& body)
{
    std::vector<glm::dvec3> out;
    const auto list = std::find_if(body.elements.rbegin(), body.elements.rend(), [](const Body::Elements& e) {
        return e.kind == kMembrane; // the last one: it came when the body was resolved
    });
    if (list == body.elements.rend())
        return out;
    for (std::size_t t = 0; t < list->vertices.size() / 3; ++t)
    {
        const auto x = [&](std::size_t corner) {
            return body.mesh.positions[list->vertices[3 * t + corner]];
        };
        out.push_back((x(1) - x(0)) * list->values[8 * t] + (x(2) - x(0)) * list->values[8 * t + 2]);
    }
    return out;
}

namespace {

std::string named(const Body& body, std::size_t triangle)
{
    const auto& t = body.mesh.triangles[triangle];
    return "triangle " + std::to_string(triangle) + " of the body (vertices " + std::to_string(t[0]) + ", " +
           std::to_string(t[1]) + ", " + std::to_string(t[2]) + ')';
}

/// The warp of each triangle of one body, before it is projected onto the triangle.
class Grain
{
public:
    explicit Grain(const Body& body)
        : body_(body),
          fabric_(body.material.fabric),
          turn_(glm::radians(fabric_.grain_degrees))
    {
        const std::vector<Keyframe> turn = {
            {0, glm::dvec3(0), body.transform.rotate_axis, body.transform.rotate_degrees, glm::dvec3(0)}};
        direction_ = pose(turn, 0, fabric_.grain);
    }

    /// Nothing, once `out` knows why.
    std::optional<glm::dvec3> of(std::size_t triangle, const Checker& out) const
    {
        const std::array<glm::dvec3, 3> x = corners(body_.mesh, triangle);
        const bool texture = fabric_.grain_of == GrainSource::texture;
        const std::optional<glm::dvec3> along = texture ? by_texture(triangle, x, out) : direction_;
        if (!along)
            return {};
        if (stands_on(*along, x))
        {
            out.error("grain", "is " + shown(*along) + ", which is within a degree of the normal of " +
                                   named(body_, triangle) +
                                   "; give a direction that lies in no triangle's normal, in the frame "
                                   "of the shape");
            return {};
        }
        const glm::dvec3 normal = unit_normal(x);
        const glm::dvec3 warp = glm::normalize(*along - glm::dot(*along, normal) * normal);
        return std::cos(turn_) * warp + std::sin(turn_) * glm::cross(normal, warp);
    }

private:
    /// Where the second texture coordinate grows and the first does not.
    std::optional<glm::dvec3> by_texture(std::size_t triangle, const std::array<glm::dvec3, 3>& x,
                                         const Checker& out) const
    {
        const auto refuse = [&](const std::string& why) {
            out.error("grain_of", "is \"texture\", and " + why +
                                      "; give every face texture coordinates, or take \"direction\"");
            return std::nullopt;
        };
        if (body_.mesh.texture.empty())
            return refuse("the mesh has no texture coordinates");
        const auto& uv = body_.mesh.texture[triangle];
        const glm::dvec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
        const double area = d1.x * d2.y - d2.x * d1.y;
        if (!std::isfinite(area))
            return refuse(named(body_, triangle) + " has none");
        if (!(std::abs(area) > 1e-12 * std::max(glm::dot(d1, d1), glm::dot(d2, d2))))
            return refuse("those of " + named(body_, triangle) + " have no area");
        return ((x[2] - x[0]) * d1.x - (x[1] - x[0]) * d2.x) / area;
    }

    const Body& body_;
    const Fabric& fabric_;
    glm::dvec3 direction_{0};
    double turn_;
};

} // namespace

void add_membrane(Body& body, const Checker& out)
{
    apply_readings(body.material.fabric, body.material.density); // of a program; those of a file were
    check_fabric(body.material.fabric, out);
    const FabricMatrix matrix = fabric_matrix(body.material.fabric);
    const Grain grain(body);
    Body::Elements list{kMembrane, {}, {}};
    for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t)
    {
        const std::optional<glm::dvec3> warp = grain.of(t, out);
        if (!warp)
            return;
        const std::array<double, 8> values = membrane_values(corners(body.mesh, t), *warp, matrix);
        list.vertices.insert(list.vertices.end(), body.mesh.triangles[t].begin(),
                             body.mesh.triangles[t].end());
        list.values.insert(list.values.end(), values.begin(), values.end());
    }
    body.elements.push_back(std::move(list));
}

double membrane_share(const Body& body)
{
    constexpr double kShare = 1.0 / 9, kLeast = 1.0 / 144, kYarnOverShear = 10;
    const auto is_membrane = [](const Body::Elements& e) { return e.kind == kMembrane; };
    if (std::none_of(body.elements.begin(), body.elements.end(), is_membrane))
        return 1;
    const Fabric& fabric = body.material.fabric;
    const double ratio = fabric.used ? std::max(fabric.warp, fabric.weft) / shear_modulus(fabric) : 1;
    return std::max(kShare * std::min(1.0, kYarnOverShear / ratio), kLeast);
}

} // namespace taut::scene_file
