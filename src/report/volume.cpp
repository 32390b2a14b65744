#include "taut/report/volume.hpp"

#include "taut/plan/solid.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Adds one body; `now` are its own vertices.
void add_tetrahedra(const Mesh& mesh, std::span<const glm::dvec3> now, VolumeReport& out)
{
    double before = 0, after = 0;
    for (const auto& t : mesh.tetrahedra)
    {
        const double rest = volume_of(t, mesh.positions), volume = volume_of(t, now);
        before += rest;
        after += volume;
        out.inverted += !(volume > 0);
        out.worst_element = std::max(out.worst_element, std::abs(volume - rest) / rest);
    }
    if (!out.any || std::abs(after / before - 1) > std::abs(out.ratio - 1))
        out.ratio = after / before;
    out.any = true;
}

} // namespace

double enclosed_volume(const Mesh& mesh, std::span<const glm::dvec3> x)
{
    if (mesh.triangles.empty())
        return 0;
    const glm::dvec3 origin = x[mesh.triangles[0][0]]; // far from zero the terms would cancel
    double six = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        six += glm::dot(x[a] - origin, glm::cross(x[b] - origin, x[c] - origin));
    return six / 6;
}

VolumeReport measure_volume(const Scene& scene, std::span<const glm::dvec3> positions)
{
    VolumeReport out;
    std::size_t first = 0;
    for (const Body& body : scene.bodies)
    {
        const std::size_t count = body.mesh.positions.size();
        const std::span<const glm::dvec3> now = positions.subspan(first, count);
        if (!body.mesh.tetrahedra.empty())
            add_tetrahedra(body.mesh, now, out);
        first += count;
    }
    return out;
}

} // namespace taut
