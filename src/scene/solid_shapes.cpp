// Generated solids: boxes and balls of tetrahedra.

#include "taut/scene/mesh.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

namespace taut {
namespace {

using Corners = std::array<std::uint32_t, 4>;

/// Bits of a cell's corner: 1 = +x, 2 = +y, 4 = +z.
constexpr Corners kFive[] = {{0, 3, 5, 6}, {1, 0, 3, 5}, {2, 0, 3, 6}, {4, 0, 5, 6}, {7, 3, 5, 6}};
constexpr Corners kSix[] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                            {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

void turn_if_left_handed(const std::vector<glm::dvec3>& positions, Corners& t)
{
    if (six_volumes(positions, t) < 0)
        std::swap(t[2], t[3]);
}

/// Vertices of a box and its cells cut: each cell's corners are mirrored by the bits of mirror(x, y, z).
/// Faces agree where a bit depends on its own coordinate alone (six), or changes from cell to cell (five).
template <typename Mirror>
Mesh cut_box(const std::array<std::uint32_t, 3>& cells, const glm::dvec3& size, std::span<const Corners> cut,
             Mirror&& mirror)
{
    assert(cells[0] > 0 && cells[1] > 0 && cells[2] > 0);
    const auto& [nx, ny, nz] = cells;
    // Symmetric to the last bit, as the grid's.
    const auto at = [](std::uint32_t i, std::uint32_t n, double extent) {
        return 0.5 * extent * ((2.0 * i - n) / n);
    };
    Mesh mesh;
    for (std::uint32_t z = 0; z <= nz; ++z)
        for (std::uint32_t y = 0; y <= ny; ++y)
            for (std::uint32_t x = 0; x <= nx; ++x)
                mesh.positions.emplace_back(at(x, nx, size.x), at(y, ny, size.y), at(z, nz, size.z));
    const std::uint32_t row = nx + 1, layer = row * (ny + 1);
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for (std::uint32_t x = 0; x < nx; ++x)
                for (const Corners& own : cut)
                {
                    Corners t;
                    for (std::size_t k = 0; k < t.size(); ++k)
                    {
                        const std::uint32_t bits = own[k] ^ mirror(x, y, z);
                        t[k] = (z + (bits >> 2)) * layer + (y + (bits >> 1 & 1)) * row + x + (bits & 1);
                    }
                    turn_if_left_handed(mesh.positions, t);
                    mesh.tetrahedra.push_back(t);
                }
    return mesh;
}

/// The surface of the cube [-1, 1]^3 to the unit sphere, nearly evenly (Nowell 2005, "Mapping a Cube to a
/// Sphere").
glm::dvec3 cube_to_sphere(const glm::dvec3& p)
{
    const glm::dvec3 s = p * p;
    const auto stretched = [](double x, double y2, double z2) {
        return x * std::sqrt(1 - y2 / 2 - z2 / 2 + y2 * z2 / 3);
    };
    return glm::normalize(
        glm::dvec3(stretched(p.x, s.y, s.z), stretched(p.y, s.z, s.x), stretched(p.z, s.x, s.y)));
}

} // namespace

Mesh make_box(const std::array<std::uint32_t, 3>& cells, const glm::dvec3& size, bool five)
{
    // Neighbours of five are mirror images, so that the diagonals of a shared face agree.
    Mesh mesh = five ? cut_box(cells, size, kFive, [](auto x, auto y, auto z) { return (x + y + z) & 1u; })
                     : cut_box(cells, size, kSix, [](auto, auto, auto) { return 0u; });
    mesh.triangles = surface_of(mesh.tetrahedra);
    return mesh;
}

Mesh make_ball(std::uint32_t cells, double radius)
{
    // Both faces of a cell at an edge of the cube come to lie in one sphere: a tetrahedron with both would be
    // flat. With every cell's diagonal pointing outwards no tetrahedron has both.
    const auto inwards = [cells](std::uint32_t i) { return 2 * i + 1 < cells ? 1u : 0u; };
    Mesh mesh = cut_box({cells, cells, cells}, glm::dvec3(2), kSix, [&](auto x, auto y, auto z) {
        return inwards(x) | inwards(y) << 1 | inwards(z) << 2;
    });
    for (glm::dvec3& p : mesh.positions)
    {
        const glm::dvec3 a = glm::abs(p);
        const double shell = std::max({a.x, a.y, a.z});
        if (shell > 0)
            p = radius * shell * cube_to_sphere(p / shell);
    }
    mesh.triangles = surface_of(mesh.tetrahedra);
    return mesh;
}

double six_volumes(const std::vector<glm::dvec3>& x, const std::array<std::uint32_t, 4>& t)
{
    return glm::dot(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[3]] - x[t[0]]);
}

} // namespace taut
