#include "taut/scene/locking.hpp"

#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace taut {
namespace {

constexpr std::uint32_t kUnseen = ~0u;
constexpr const char* kSeen = " (docs/solids.md, \"How stiff tetrahedra are\")";

/// Per vertex: edges to the nearest vertex of the surface.
std::vector<std::uint32_t> depths(const Mesh& mesh)
{
    std::vector<std::vector<std::uint32_t>> at(mesh.positions.size()); // tetrahedra
    for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
        for (const std::uint32_t v : mesh.tetrahedra[t])
            at[v].push_back(t);
    std::vector<std::uint32_t> depth(mesh.positions.size(), kUnseen), front;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle)
            if (depth[v] == kUnseen)
            {
                depth[v] = 0;
                front.push_back(v);
            }
    for (std::size_t next = 0; next < front.size(); ++next)
        for (const std::uint32_t t : at[front[next]])
            for (const std::uint32_t v : mesh.tetrahedra[t])
                if (depth[v] == kUnseen)
                {
                    depth[v] = depth[front[next]] + 1;
                    front.push_back(v);
                }
    return depth;
}

std::string field_of(const Body& body, std::size_t number)
{
    const std::string at = "bodies[" + std::to_string(number) + "]";
    switch (body.shape.kind)
    {
    case ShapeKind::box: return at + ".box.cells";
    case ShapeKind::ball: return at + ".ball.cells";
    case ShapeKind::tetrahedra: return at + ".tetrahedra";
    default: return at + ".mesh";
    }
}

} // namespace

std::uint32_t tetrahedra_across(const Mesh& mesh)
{
    if (mesh.tetrahedra.empty() || mesh.triangles.empty())
        return 0;
    const std::vector<std::uint32_t> depth = depths(mesh);
    std::uint32_t most = 0;
    for (const auto& t : mesh.tetrahedra)
        for (const std::uint32_t v : t)
            most = std::max(most, depth[v]);
    const bool odd = std::any_of(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), [&](const auto& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return depth[v] == most; });
    });
    return 2 * most + (odd ? 1 : 0);
}

std::vector<SceneIssue> locking_issues(const Scene& resolved)
{
    std::vector<SceneIssue> out;
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        if (body.mesh.tetrahedra.empty() || body.kinematic.used)
            continue;
        const double ratio = body.material.poissons_ratio;
        const bool incompressible = ratio > kIncompressible;
        const std::uint32_t across = tetrahedra_across(body.mesh);
        const std::uint32_t least = incompressible ? kAcrossIncompressible : kAcrossToBend;
        if (across < least)
            out.push_back({false, field_of(body, b),
                           "makes a solid of " + std::to_string(across) +
                               (across == 1 ? " tetrahedron" : " tetrahedra") +
                               " across where it is thickest" +
                               (incompressible ? " and a Poisson's ratio of " + shown(ratio, 3) : "") +
                               "; one that bends needs at least " + std::to_string(least) +
                               ", or is too stiff" + kSeen});
        if (body.material.model == SolidModel::springs)
            out.push_back({false, "bodies[" + std::to_string(b) + "].material.model",
                           std::string("is \"springs\", which are stiffer than youngs_modulus says however "
                                       "fine the mesh is") +
                               kSeen});
    }
    return out;
}

} // namespace taut
