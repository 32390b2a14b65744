#include "taut/plan/surface.hpp"

#include "taut/plan/solid.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace taut {
namespace {

/// What a surface of this area [m^2] has to enclose at least, as a share of area^1.5 (a ball: 0.094).
constexpr double kLeastVolume = 1e-9;

} // namespace

bool holds_surface_volume(const Body& body)
{
    const bool asked = body.mesh.tetrahedra.empty() ? body.material.volume_stiffness > 0
                                                    : body.material.model == SolidModel::springs &&
                                                          body.material.volume == HeldVolume::surface;
    return asked && bulk_modulus(body.material) > 0;
}

SurfaceElement surface_element(const Body& body)
{
    SurfaceElement out;
    out.triangles = body.mesh.triangles;
    out.rest_volume = enclosed_volume(out.triangles, body.mesh.positions);
    out.compliance = std::abs(out.rest_volume) / bulk_modulus(body.material); // 0 for an infinite modulus
    return out;
}

std::vector<UnpairedEdge> unpaired_edges(std::span<const std::array<std::uint32_t, 3>> triangles)
{
    std::map<std::array<std::uint32_t, 2>, UnpairedEdge> edges;
    for (const auto& t : triangles)
        for (std::size_t k = 0; k < 3; ++k)
        {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            const std::array<std::uint32_t, 2> ends = {std::min(from, to), std::max(from, to)};
            UnpairedEdge& edge = edges.try_emplace(ends, UnpairedEdge{ends[0], ends[1]}).first->second;
            ++(from < to ? edge.up : edge.down);
        }
    std::vector<UnpairedEdge> out;
    for (const auto& [ends, edge] : edges)
        if (edge.up != edge.down)
            out.push_back(edge);
    return out;
}

void check_surface(const Body& body, const std::string& where, const std::string& setting)
{
    double area = 0;
    const std::vector<glm::dvec3>& x = body.mesh.positions;
    for (const auto& t : body.mesh.triangles)
        area += 0.5 * glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
    const std::vector<UnpairedEdge> unpaired = unpaired_edges(body.mesh.triangles);
    if (!unpaired.empty())
    {
        const UnpairedEdge& first = unpaired.front();
        const std::string between =
            " between the vertices " + std::to_string(first.low) + " and " + std::to_string(first.high);
        throw Error(ErrorCode::bad_input,
                    where + (first.up + first.down == 1
                                 ? ", but the surface is open at the edge" + between +
                                       "; close it, or set " + setting + " to 0"
                                 : ", but triangles at the edge" + between +
                                       " look to different sides; turn them, or set " + setting + " to 0"));
    }
    if (!(std::abs(enclosed_volume(body.mesh.triangles, x)) > kLeastVolume * std::pow(area, 1.5)))
        throw Error(ErrorCode::degenerate_rest,
                    where + ", but the surface encloses no volume; set " + setting + " to 0");
}

double enclosed_volume(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const glm::dvec3> x)
{
    double six = 0;
    for (const auto& [a, b, c] : triangles)
    {
        const glm::dvec3 origin = x[triangles[0][0]];
        six += glm::dot(x[a] - origin, glm::cross(x[b] - origin, x[c] - origin));
    }
    return six / 6;
}

void add_volume_gradient(std::span<const std::array<std::uint32_t, 3>> triangles,
                         std::span<const glm::dvec3> x, double factor, std::span<glm::dvec3> out)
{
    for (const auto& t : triangles)
    {
        const glm::dvec3 origin = x[triangles[0][0]];
        for (std::size_t k = 0; k < 3; ++k)
            out[t[k]] += glm::cross(x[t[(k + 1) % 3]] - origin, x[t[(k + 2) % 3]] - origin) * (factor / 6);
    }
}

} // namespace taut
