#include "taut/report/volume.hpp"

#include "taut/plan/solid.hpp"
#include "taut/plan/surface.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

void add_ratio(double ratio, VolumeReport& out)
{
    if (!out.any || std::abs(ratio - 1) > std::abs(out.ratio - 1))
        out.ratio = ratio;
    out.least = out.any ? std::min(out.least, ratio) : ratio;
    out.any = true;
}

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
    add_ratio(after / before, out);
}

} // namespace

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
        else if (holds_surface_volume(body) || body.material.pressure != 0)
        {
            const auto& triangles = body.mesh.triangles;
            add_ratio(enclosed_volume(triangles, now) / enclosed_volume(triangles, body.mesh.positions), out);
        }
        first += count;
    }
    return out;
}

} // namespace taut
