// Generated solids: boxes and balls of tetrahedra.

#include "taut/scene/mesh.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
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

} // namespace

Mesh make_box(const std::array<std::uint32_t, 3>& cells, const glm::dvec3& size, bool five)
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
    for (std::uint32_t z = 0; z < nz; ++z)
        for (std::uint32_t y = 0; y < ny; ++y)
            for (std::uint32_t x = 0; x < nx; ++x)
            {
                // Neighbours of five are mirror images, so that the diagonals of a shared face agree.
                const std::uint32_t mirror = five && (x + y + z) % 2 == 1 ? 1 : 0;
                const auto corner = [&](std::uint32_t bits) {
                    bits ^= mirror;
                    return ((z + (bits >> 2)) * (ny + 1) + y + ((bits >> 1) & 1)) * (nx + 1) + x + (bits & 1);
                };
                const auto add = [&](const Corners& own) {
                    Corners t = {corner(own[0]), corner(own[1]), corner(own[2]), corner(own[3])};
                    turn_if_left_handed(mesh.positions, t);
                    mesh.tetrahedra.push_back(t);
                };
                if (five)
                    std::for_each(std::begin(kFive), std::end(kFive), add);
                else
                    std::for_each(std::begin(kSix), std::end(kSix), add);
            }
    mesh.triangles = surface_of(mesh.tetrahedra);
    return mesh;
}

Mesh make_ball(std::uint32_t cells, double radius)
{
    Mesh mesh = make_box({cells, cells, cells}, glm::dvec3(2), true);
    for (glm::dvec3& p : mesh.positions)
    {
        const glm::dvec3 a = glm::abs(p);
        const double shell = std::max({a.x, a.y, a.z}), length = glm::length(p);
        p *= length > 0 ? radius * shell / length : 0.0;
    }
    return mesh;
}

double six_volumes(const std::vector<glm::dvec3>& x, const std::array<std::uint32_t, 4>& t)
{
    return glm::dot(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]), x[t[3]] - x[t[0]]);
}

} // namespace taut
