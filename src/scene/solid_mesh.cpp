// Tetrahedra made sound: handedness, volumes, stray vertices, the surface.

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/mesh.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

/// A tetrahedron this flat, measured by the cube of its longest edge, has no volume to hold or to divide by.
constexpr double kFlat = 1e-12;

double longest_edge(const std::vector<glm::dvec3>& x, const std::array<std::uint32_t, 4>& t)
{
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
            longest = std::max(longest, glm::distance(x[t[i]], x[t[j]]));
    return longest;
}

void refuse_flat(const std::vector<glm::dvec3>& x, const std::vector<std::array<std::uint32_t, 4>>& all,
                 const std::string& name)
{
    std::size_t count = 0, first = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
    {
        const double longest = longest_edge(x, all[k]);
        // Divided first: the cube of a length may not fit.
        const double share = six_volumes(x, all[k]) / longest / longest / longest;
        if (std::abs(share) > 6 * kFlat)
            continue;
        first = count == 0 ? k : first;
        ++count;
    }
    if (count == 0)
        return;
    std::string corners;
    for (const std::uint32_t v : all[first])
        corners += (corners.empty() ? "" : ", ") + std::to_string(v);
    throw Error(ErrorCode::degenerate_rest,
                name + ": tetrahedron " + std::to_string(first) + " (vertices " + corners +
                    ", numbered from 0) has no volume" +
                    (count > 1 ? ", and " + std::to_string(count - 1) + " others have none" : "") +
                    "; remove or remesh them");
}

struct Face
{
    std::array<std::uint32_t, 3> sorted, wound;
    std::size_t tetrahedron;
};

} // namespace

std::vector<std::array<std::uint32_t, 3>>
surface_of(const std::vector<std::array<std::uint32_t, 4>>& tetrahedra)
{
    std::vector<Face> faces;
    faces.reserve(4 * tetrahedra.size());
    for (std::size_t k = 0; k < tetrahedra.size(); ++k)
    {
        const auto& [a, b, c, d] = tetrahedra[k];
        for (const std::array<std::uint32_t, 3>& wound :
             {std::array{b, c, d}, std::array{a, d, c}, std::array{a, b, d}, std::array{a, c, b}})
        {
            Face face{wound, wound, k};
            std::sort(face.sorted.begin(), face.sorted.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return a.sorted != b.sorted ? a.sorted < b.sorted : a.tetrahedron < b.tetrahedron;
    });
    std::vector<Face> outer;
    for (std::size_t k = 0; k < faces.size();)
    {
        std::size_t end = k + 1;
        while (end < faces.size() && faces[end].sorted == faces[k].sorted)
            ++end;
        if (end == k + 1)
            outer.push_back(faces[k]);
        k = end;
    }
    std::stable_sort(outer.begin(), outer.end(),
                     [](const Face& a, const Face& b) { return a.tetrahedron < b.tetrahedron; });
    std::vector<std::array<std::uint32_t, 3>> out;
    for (const Face& face : outer)
        out.push_back(face.wound);
    return out;
}

Mesh solid_mesh(std::vector<glm::dvec3> positions, std::vector<std::array<std::uint32_t, 4>> tetrahedra,
                const std::string& name, MeshFindings& findings)
{
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    refuse_flat(positions, tetrahedra, name);
    std::vector<std::uint32_t> number(positions.size(), unused);
    for (auto& t : tetrahedra)
    {
        if (six_volumes(positions, t) < 0)
        {
            std::swap(t[2], t[3]);
            ++findings.turned_tetrahedra;
        }
        for (const std::uint32_t v : t)
            number[v] = 0;
    }
    Mesh mesh;
    for (std::size_t v = 0; v < positions.size(); ++v)
    {
        if (number[v] == unused)
        {
            ++findings.unused_vertices;
            continue;
        }
        number[v] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(positions[v]);
    }
    for (auto& t : tetrahedra)
        for (std::uint32_t& v : t)
            v = number[v];
    mesh.tetrahedra = std::move(tetrahedra);
    mesh.triangles = surface_of(mesh.tetrahedra);
    return mesh;
}

} // namespace taut
