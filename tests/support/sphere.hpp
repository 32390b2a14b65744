#pragma once
// A sphere of triangles: an octahedron whose faces are cut n by n, 4 n^2 + 2 vertices.

#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <map>
#include <tuple>

namespace taut::test {

inline Mesh sphere_mesh(int n, double radius)
{
    Mesh mesh;
    std::map<std::tuple<int, int, int>, std::uint32_t> seen;
    const auto vertex = [&](glm::ivec3 at) {
        const auto [entry, is_new] =
            seen.emplace(std::tuple(at.x, at.y, at.z), static_cast<std::uint32_t>(mesh.positions.size()));
        if (is_new)
            mesh.positions.push_back(radius * glm::normalize(glm::dvec3(at)));
        return entry->second;
    };
    for (int octant = 0; octant < 8; ++octant)
    {
        const glm::ivec3 sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
        const bool mirrored = sign.x * sign.y * sign.z < 0;
        const auto add = [&](glm::ivec3 a, glm::ivec3 b, glm::ivec3 c) {
            if (mirrored)
                std::swap(b, c);
            mesh.triangles.push_back({vertex(a * sign), vertex(b * sign), vertex(c * sign)});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
            {
                const glm::ivec3 a(n - i - j, i, j), b(n - i - j - 1, i + 1, j), c(n - i - j - 1, i, j + 1);
                add(a, b, c);
                if (i + j + 1 < n)
                    add(b, {n - i - j - 2, i + 1, j + 1}, c);
            }
    }
    return mesh;
}

/// That sphere as closed cloth: mass 1 kg, a spring of `stiffness` [N/m] along every edge. Its scene has no
/// colliders; 1 ms a substep, one substep a step.
inline Scene ball_of_springs(int n, double radius, double stiffness, double volume_stiffness)
{
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh = sphere_mesh(n, radius);
    body.material.stretch_stiffness = 0;
    body.material.volume_stiffness = volume_stiffness;
    body.vertex_masses.assign(body.mesh.positions.size(),
                              1.0 / static_cast<double>(body.mesh.positions.size()));
    for (const auto& t : body.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] < t[(k + 1) % 3])
                body.springs.push_back(
                    {t[k], t[(k + 1) % 3],
                     glm::distance(body.mesh.positions[t[k]], body.mesh.positions[t[(k + 1) % 3]]),
                     1 / stiffness});
    Scene scene;
    scene.timestep = 1e-3;
    scene.method.type = MethodKind::mass_spring;
    scene.method.substeps = 1;
    scene.bodies = {body};
    return scene;
}

} // namespace taut::test
