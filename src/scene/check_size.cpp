// Whether the arithmetic of a run can hold a body of this size.

#include "taut/scene/check_size.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::scene_file {
namespace {

/// What says how large a body is.
const char* size_field(ShapeKind kind)
{
    switch (kind)
    {
    case ShapeKind::grid: return "grid.size";
    case ShapeKind::chain: return "chain.length";
    case ShapeKind::box: return "box.size";
    case ShapeKind::ball: return "ball.radius";
    case ShapeKind::tetrahedra: return "tetrahedra";
    case ShapeKind::mesh: break;
    }
    return "mesh";
}

double longest_edge(const Mesh& mesh)
{
    double longest = 0;
    const auto take = [&](const auto& corners, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < i; ++k)
                longest =
                    std::max(longest, glm::distance(mesh.positions[corners[i]], mesh.positions[corners[k]]));
    };
    for (const auto& triangle : mesh.triangles)
        take(triangle, 3);
    for (const auto& tetrahedron : mesh.tetrahedra)
        take(tetrahedron, 4);
    for (const auto& link : mesh.links)
        take(link, 2);
    return longest;
}

} // namespace

void check_size(const Body& body, bool twice, const Checker& out)
{
    const double longest = longest_edge(body.mesh);
    if (!(longest > 0)) // a lone particle, or what others complain of
        return;
    const double least = twice ? std::numeric_limits<double>::min() : std::numeric_limits<float>::min();
    const double most = twice ? std::numeric_limits<double>::max() : std::numeric_limits<float>::max();
    const double rounding =
        twice ? std::numeric_limits<double>::epsilon() / 2 : std::numeric_limits<float>::epsilon() / 2;
    const std::string is = "makes no edge longer than " + shown(longest) + " m";
    const std::string right = std::string("; lengths are in metres") +
                              (body.transform.scale != 1 ? ", after transform.scale" : "") +
                              (twice ? "" : ", and method.precision \"double\" holds more");
    // Lengths are roots of squares.
    if (longest < std::sqrt(least))
        out.error(size_field(body.shape.kind), is + ", whose square no " + (twice ? "double" : "float") +
                                                   " holds: at least " + shown(std::sqrt(least), 2) +
                                                   " m would be right" + right);
    else if (longest > std::sqrt(most))
        out.error(size_field(body.shape.kind), "makes an edge of " + shown(longest) + " m, whose square no " +
                                                   (twice ? "double" : "float") + " holds: at most " +
                                                   shown(std::sqrt(most), 2) + " m would be right" + right);
    // Areas come in squares too: gradients of volumes and angles.
    else if (const double fine = std::sqrt(std::sqrt(least / rounding));
             longest < fine && (!body.mesh.tetrahedra.empty() || resists_bending(body.material)))
        out.warning(size_field(body.shape.kind),
                    is + ": the square of an area is below what a " + (twice ? "double" : "float") +
                        " holds to its last digit, and a run may end with values that are not finite; " +
                        shown(fine, 2) + " m and more are safe" + right);
}

} // namespace taut::scene_file
