#pragma once
// Internal to src/scene: what a resolved body measures at rest.

#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut {

/// m^2, of all triangles.
inline double area_of(const Body& body)
{
    const auto& x = body.mesh.positions;
    double area = 0;
    for (const auto& t : body.mesh.triangles)
        area += glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]])) / 2;
    return area;
}

/// m^3, of all tetrahedra.
inline double volume_of(const Body& body)
{
    const auto& x = body.mesh.positions;
    double volume = 0;
    for (const auto& t : body.mesh.tetrahedra)
        volume += std::abs(glm::dot(x[t[1]] - x[t[0]], glm::cross(x[t[2]] - x[t[0]], x[t[3]] - x[t[0]]))) / 6;
    return volume;
}

/// m: of a bar of square section its side, by volume over surface.
inline double thickness_of(const Body& body)
{
    const double area = area_of(body);
    return area > 0 ? 4 * volume_of(body) / area : 0;
}

/// kg
inline double mass_of(const Body& body)
{
    if (!body.vertex_masses.empty())
        return std::accumulate(body.vertex_masses.begin(), body.vertex_masses.end(), 0.0);
    return body.material.density * (body.mesh.tetrahedra.empty() ? area_of(body) : volume_of(body));
}

/// N/m of a network along its rows: springs over two edges overlap, and are twice as long.
inline double network_stiffness(const SpringNetwork& network)
{
    return network.structural + network.shear + 4 * network.bend;
}

/// (m/s)^2 of waves along a body: of a fabric along its stiffer yarns.
inline double wave_speed_squared(const Body& body)
{
    const Material& m = body.material;
    if (!(m.density > 0))
        return 0;
    if (!body.mesh.tetrahedra.empty())
        return m.youngs_modulus / m.density;
    const SpringNetwork& network = body.shape.network;
    const double along = m.fabric.used  ? std::max(m.fabric.warp, m.fabric.weft)
                         : network.used ? network_stiffness(network)
                                        : m.stretch_stiffness;
    return body.mesh.triangles.empty() || !std::isfinite(along) ? 0 : along / m.density;
}

} // namespace taut
