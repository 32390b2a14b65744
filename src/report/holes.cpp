#include "taut/report/holes.hpp"

#include "taut/report/crossing_shapes.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/called.hpp"
#include "taut/scene/faces.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace taut {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// m, radius of what a box goes through end first.
double round_box(const glm::dvec3& half)
{
    std::array<double, 3> sorted{half.x, half.y, half.z};
    std::sort(sorted.begin(), sorted.end());
    return std::hypot(sorted[0], sorted[1]);
}

/// m, radius of what a shape goes through end first.
double slimmest(const SolidShape& shape)
{
    if (shape.radius > 0)
        return shape.size;
    double least = shape.solid.field ? glm::length(shape.half) : round_box(shape.half);
    for (const DeepPoint& p : shape.deep)
        least = std::min(least, round_box(p.half));
    return least;
}

std::string cure_of(const Collider& collider)
{
    if (has_faces(collider.kind))
        return "let it meet triangles (\"meets\": \"surface\"), or take smaller ones";
    return "take smaller triangles, or a kinematic body, which edges and triangles meet, too "
           "(docs/contact.md, \"Meshes that are led\")";
}

} // namespace

std::vector<SceneIssue> holes_issues(const Scene& resolved)
{
    std::vector<SceneIssue> out;
    std::vector<double> radii; // of colliders; infinite of planes
    for (const Collider& collider : resolved.colliders)
        radii.push_back(solid_of(collider).bounded ? slimmest(solid_shape(collider)) : kNoEnd);
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        const double hole = body.kinematic.used ? 0 : largest_hole(body) - body.material.thickness;
        for (std::size_t c = 0; c < radii.size(); ++c)
            if (radii[c] < hole && !meets_surface(body, resolved.colliders[c]))
                out.push_back({false, "colliders[" + std::to_string(c) + "]",
                               "goes through the triangles of " + called("bodies", b, body.name) +
                                   ": it meets vertices alone, is " + shown(radii[c], 3) +
                                   " m round, and between vertices there is room for " + shown(hole, 3) +
                                   " m; " + cure_of(resolved.colliders[c])});
    }
    return out;
}

} // namespace taut
