#pragma once
// Small meshes for the tests of edges, hinges and vertex order.

#include "taut/plan/topology.hpp"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace taut::meshes {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline Mesh mesh_of(std::size_t vertices, Triangles triangles)
{
    Mesh mesh;
    mesh.positions.resize(vertices, glm::dvec3(0));
    mesh.triangles = std::move(triangles);
    return mesh;
}

inline Mesh tetrahedron_surface() { return mesh_of(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}); }

/// columns x rows vertices, each cell cut along the same diagonal.
inline Mesh cut_grid(std::uint32_t columns, std::uint32_t rows)
{
    Mesh mesh;
    for (std::uint32_t y = 0; y < rows; ++y)
    {
        for (std::uint32_t x = 0; x < columns; ++x)
        {
            mesh.positions.emplace_back(x, y, 0);
            if (x + 1 < columns && y + 1 < rows)
            {
                const std::uint32_t v = y * columns + x;
                mesh.triangles.push_back({v, v + 1, v + columns + 1});
                mesh.triangles.push_back({v, v + columns + 1, v + columns});
            }
        }
    }
    return mesh;
}

} // namespace taut::meshes
