#include "taut/scene/fabric_mesh.hpp"

#include "taut/runtime/base/shown.hpp"
#include "taut/scene/extent.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace taut {
namespace {

/// m, over the edges of triangles at rest, each as often as triangles have it.
double mean_edge(const Mesh& mesh)
{
    double sum = 0;
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            sum += glm::distance(mesh.positions[t[k]], mesh.positions[t[(k + 1) % 3]]);
    return mesh.triangles.empty() ? 0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

/// m, the diagonal of the box around the body at rest.
double size_of(const Mesh& mesh)
{
    Extent box;
    for (const glm::dvec3& x : mesh.positions)
        box.take(x);
    return box.size();
}

double rigidity_of(const Material& material)
{
    const FabricBending& bending = material.fabric.bending;
    return bending.used ? std::min(bending.warp, bending.weft) : material.bending_stiffness;
}

std::string in_millimetres(double metres) { return shown(1000 * metres, 3) + " mm"; }

} // namespace

std::vector<SceneIssue> fabric_mesh_issues(const Scene& resolved)
{
    std::vector<SceneIssue> out;
    const double gravity = glm::length(resolved.gravity);
    const double digit = resolved.method.precision == Precision::float64
                             ? std::numeric_limits<double>::epsilon()
                             : double(std::numeric_limits<float>::epsilon());
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        const double weight = body.material.density * gravity; // N/m^2
        if (!body.material.fabric.used || body.kinematic.used || !(weight > 0))
            continue;
        const std::string at = "bodies[" + std::to_string(b) + "]";
        const double edge = mean_edge(body.mesh), rigidity = rigidity_of(body.material);
        const double bend = std::cbrt(rigidity / weight);
        if (rigidity > 0 && kEdgesInBend * edge > bend)
            out.push_back({false, at + (body.shape.kind == ShapeKind::grid ? ".grid.cells" : ".mesh"),
                           "makes edges of " + in_millimetres(edge) +
                               "; by its weight this fabric bends over " + in_millimetres(bend) +
                               ", in which " + shown(kEdgesInBend, 3) +
                               " edges have to fit, or folds are stiffer and wider than they should be"});
        const double modulus = std::max(body.material.fabric.warp, body.material.fabric.weft);
        if (weight * size_of(body.mesh) < 0.5 * digit * modulus)
            out.push_back(
                {false, at + ".material.fabric",
                 "is as stiff as " + shown(modulus, 3) + " N/m: by its own weight it is strained by " +
                     shown(weight * size_of(body.mesh) / modulus, 3) + ", below the last digit of \"" +
                     std::string(to_string(resolved.method.precision)) + "\"; what it does is rounding"});
    }
    return out;
}

} // namespace taut
