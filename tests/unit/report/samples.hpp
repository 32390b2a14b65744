#pragma once
// Small scenes with known answers.

#include "taut/scene/scene.hpp"

#include <cmath>

namespace samples {

inline taut::Scene scene_of(taut::Body body, glm::dvec3 gravity = {0, -9.81, 0})
{
    taut::Scene scene;
    scene.gravity = gravity;
    scene.bodies.push_back(std::move(body));
    return scene;
}

/// n x n particles on the unit square in z = 0, the boundary pinned; structural springs of k = 1000 N/m,
/// 5 % longer than at rest; particle mass sigma * spacing^2 (methods A4). Gravity along -z.
inline taut::Scene stretched_net(std::uint32_t n, double sigma)
{
    taut::Body body;
    const double spacing = 1.0 / (n - 1);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x)
        {
            const std::uint32_t v = y * n + x;
            body.mesh.positions.emplace_back(x * spacing, y * spacing, 0);
            if (x + 1 < n)
                body.springs.push_back({v, v + 1, spacing / 1.05, 1e-3});
            if (y + 1 < n)
                body.springs.push_back({v, v + n, spacing / 1.05, 1e-3});
            if (x == 0 || y == 0 || x + 1 == n || y + 1 == n)
            {
                if (body.pins.empty())
                    body.pins.emplace_back();
                body.pins[0].vertices.push_back(v);
            }
        }
    body.vertex_masses.assign(n * n, sigma * spacing * spacing);
    return scene_of(std::move(body), {0, 0, -9.81});
}

/// n links of spring stiffness k along -y, equal joint masses, the first joint pinned.
inline taut::Scene spring_chain(std::uint32_t n, double mass, double k)
{
    taut::Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        body.mesh.positions.emplace_back(0, -0.1 * i, 0);
    for (std::uint32_t i = 0; i < n; ++i)
        body.springs.push_back({i, i + 1, 0.1, 1 / k});
    body.vertex_masses.assign(n + 1, mass);
    body.pins.emplace_back().vertices = {0};
    return scene_of(std::move(body));
}

/// columns x rows squares of right triangles, all diagonals one way, row by row; x across, y down.
inline taut::Mesh right_triangles(std::uint32_t columns, std::uint32_t rows, double dx, double dy)
{
    taut::Mesh mesh;
    for (std::uint32_t r = 0; r <= rows; ++r)
        for (std::uint32_t c = 0; c <= columns; ++c)
            mesh.positions.emplace_back(c * dx, -(r * dy), 0);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
        {
            const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

/// Equilateral triangles of side `side`; odd rows are shifted by half a side.
inline taut::Mesh equilateral_triangles(std::uint32_t columns, std::uint32_t rows, double side)
{
    taut::Mesh mesh = right_triangles(columns, rows, side, side * std::sqrt(3.0) / 2);
    mesh.triangles.clear();
    for (std::uint32_t r = 0; r <= rows; ++r)
        for (std::uint32_t c = 0; c <= columns; ++c)
        {
            const std::uint32_t a = r * (columns + 1) + c, b = a + columns + 1;
            if (r % 2 == 1)
                mesh.positions[a].x += side / 2;
            if (r == rows || c == columns)
                continue;
            if (r % 2 == 0)
            {
                mesh.triangles.push_back({a, b, a + 1});
                mesh.triangles.push_back({a + 1, b, b + 1});
            }
            else
            {
                mesh.triangles.push_back({a, b, b + 1});
                mesh.triangles.push_back({a, b + 1, a + 1});
            }
        }
    return mesh;
}

} // namespace samples
