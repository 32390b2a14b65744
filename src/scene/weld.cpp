#include "taut/scene/weld.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace taut::scene_file {

namespace {

struct Cell
{
    double x, y, z; // whole numbers, or the coordinates themselves when only equals are welded
    bool operator==(const Cell&) const = default;
};

struct CellHash
{
    std::size_t operator()(const Cell& cell) const
    {
        std::uint64_t hash = 0xcbf29ce484222325ull;
        for (const double part : {cell.x, cell.y, cell.z})
        {
            // + 0.0 makes -0 and 0 one.
            hash = (hash ^ std::bit_cast<std::uint64_t>(part + 0.0)) * 0x9e3779b97f4a7c15ull;
            hash ^= hash >> 29;
        }
        return static_cast<std::size_t>(hash);
    }
};

using Grid = std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash>;

std::vector<std::uint32_t> weld_equal(std::span<const glm::dvec3> positions)
{
    std::unordered_map<Cell, std::uint32_t, CellHash> first;
    first.reserve(positions.size());
    std::vector<std::uint32_t> target(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v)
        target[v] = first.emplace(Cell{positions[v].x, positions[v].y, positions[v].z}, v).first->second;
    return target;
}

/// The first kept position within `distance` of p in the 27 cells around it; `none` if there is none.
std::uint32_t find_near(const Grid& grid, const Cell& cell, std::span<const glm::dvec3> positions,
                        const glm::dvec3& p, double distance, std::uint32_t none)
{
    std::uint32_t best = none;
    for (int n = 0; n < 27; ++n)
    {
        const auto found = grid.find({cell.x + n % 3 - 1, cell.y + n / 3 % 3 - 1, cell.z + n / 9 - 1});
        if (found == grid.end())
            continue;
        for (const std::uint32_t v : found->second)
            if (v < best && glm::distance(positions[v], p) <= distance)
                best = v;
    }
    return best;
}

struct Edge
{
    std::uint32_t a, b;
    auto operator<=>(const Edge&) const = default;
};

void count_edges(const Mesh& mesh, MeshFindings& findings)
{
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            edges.push_back({std::min(t[c], t[(c + 1) % 3]), std::max(t[c], t[(c + 1) % 3])});
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end)
    {
        while (end < edges.size() && edges[end] == edges[begin])
            ++end;
        if (end - begin == 1)
            ++findings.boundary_edges;
        else if (end - begin > 2)
            findings.non_manifold_edges.push_back({edges[begin].a, edges[begin].b});
    }
}

struct TripleHash
{
    std::size_t operator()(const std::array<std::uint32_t, 3>& t) const
    {
        return CellHash{}({static_cast<double>(t[0]), static_cast<double>(t[1]), static_cast<double>(t[2])});
    }
};

/// Triangles by their corners in ascending order, whichever way round they are.
using Triples = std::unordered_set<std::array<std::uint32_t, 3>, TripleHash>;

bool is_new(Triples& known, std::array<std::uint32_t, 3> corners)
{
    std::sort(corners.begin(), corners.end());
    return known.insert(corners).second;
}

/// A repeated corner, or corners so nearly on a line that rounding leaves no area.
bool is_degenerate(const std::array<std::uint32_t, 3>& t, std::span<const glm::dvec3> p)
{
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
        return true;
    const glm::dvec3 u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]], w = p[t[2]] - p[t[1]];
    // Scaled by the longest side, so that no unit of length is special and nothing under- or overflows.
    const double longest = std::max({glm::length(u), glm::length(v), glm::length(w)});
    return !(longest > 0) || !(glm::length(glm::cross(u / longest, v / longest)) > 1e-14);
}

} // namespace

void add_face(RawMesh& mesh, std::span<const std::uint32_t> corners)
{
    for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

std::vector<std::uint32_t> weld_targets(std::span<const glm::dvec3> positions, double distance)
{
    double farthest = 0;
    for (const glm::dvec3& p : positions)
        farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (distance >= 0 && distance <= farthest * 1e-15) // below the spacing of doubles
        return weld_equal(positions);
    std::vector<std::uint32_t> target(positions.size());
    Grid grid;
    for (std::uint32_t v = 0; v < positions.size(); ++v)
    {
        target[v] = v;
        if (!(distance > 0))
            continue;
        const glm::dvec3 p = positions[v];
        // Doubles, not integers: a tiny distance far from the origin must not overflow.
        const Cell cell{std::floor(p.x / distance), std::floor(p.y / distance), std::floor(p.z / distance)};
        target[v] = find_near(grid, cell, positions, p, distance, v);
        if (target[v] == v)
            grid[cell].push_back(v);
    }
    return target;
}

Mesh clean(const RawMesh& raw, double weld_distance, MeshFindings& findings, std::vector<std::uint32_t>* kept)
{
    const std::vector<std::uint32_t> target = weld_targets(raw.positions, weld_distance);
    for (std::uint32_t v = 0; v < target.size(); ++v)
        findings.welded_vertices += target[v] != v;

    Mesh mesh;
    Triples known;
    known.reserve(raw.triangles.size());
    std::vector<bool> used(raw.positions.size(), false);
    for (std::uint32_t t = 0; t < raw.triangles.size(); ++t)
    {
        std::array<std::uint32_t, 3> triangle = raw.triangles[t];
        for (std::uint32_t& corner : triangle)
            corner = target[corner];
        if (is_degenerate(triangle, raw.positions))
        {
            findings.degenerate_triangles.push_back(t);
            continue;
        }
        if (!is_new(known, triangle)) // its mass and its pushes would count twice
        {
            findings.repeated_triangles.push_back(t);
            continue;
        }
        for (const std::uint32_t corner : triangle)
            used[corner] = true;
        mesh.triangles.push_back(triangle);
        if (!raw.texture.empty())
            mesh.texture.push_back(raw.texture[t]);
    }

    std::vector<std::uint32_t> number(raw.positions.size(), 0);
    for (std::uint32_t v = 0; v < raw.positions.size(); ++v)
    {
        if (!used[v])
        {
            findings.unused_vertices += target[v] == v;
            continue;
        }
        number[v] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(raw.positions[v]);
        if (kept)
            kept->push_back(v);
    }
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle)
            corner = number[corner];
    count_edges(mesh, findings);
    return mesh;
}

} // namespace taut::scene_file
