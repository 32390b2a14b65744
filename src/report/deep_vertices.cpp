#include "taut/report/deep_vertices.hpp"

#include "taut/report/contact.hpp"
#include "taut/report/model.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/called.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/held.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

/// m: of a body of one vertex, that of the scene.
double size_at_rest(const Scene& scene, const Body& body)
{
    Extent all;
    for (const glm::dvec3& p : body.mesh.positions)
        all.take(p);
    return all.size() > 0 ? all.size() : rest_diameter(scene);
}

/// "0.1 m deep in colliders[1] (ball)"
std::string how_deep(const Scene& scene, const DeepVertex& deep, double depth)
{
    return shown(depth, 3) + " m deep in " +
           called("colliders", deep.collider, scene.colliders[deep.collider].name);
}

/// m, at `depth`: beyond what is accepted.
double excess(const DeepVertex& deep, double depth) { return depth - kDeepShare * deep.size - deep.rounding; }

/// Of a vertex whose heights above the surfaces are given: into each collider's entry. One that is no higher
/// than `near` (m) is held by that collider.
void take(std::span<const double> heights, double near, std::size_t vertex, std::vector<DeepVertex>& deepest)
{
    const auto holds = [&](double height) { return height <= near; };
    const bool roomy = std::count_if(heights.begin(), heights.end(), holds) < 2;
    for (std::size_t c = 0; c < heights.size(); ++c)
    {
        DeepVertex& deep = deepest[c];
        deep.depth = std::max(deep.depth, -heights[c]);
        if (roomy && -heights[c] > deep.roomy)
        {
            deep.roomy = -heights[c];
            deep.vertex = vertex;
        }
    }
}

} // namespace

std::vector<DeepVertex> deep_vertices(const Scene& resolved, std::span<const glm::dvec3> x, double time)
{
    std::vector<reference::Surface> surfaces;
    for (const Collider& collider : resolved.colliders)
        surfaces.push_back(reference::surface_at(collider, time));
    std::vector<DeepVertex> out;
    std::vector<double> heights(surfaces.size());
    std::size_t first = 0;
    for (std::size_t b = 0; b < resolved.bodies.size() && !surfaces.empty(); ++b)
    {
        const Body& body = resolved.bodies[b];
        const std::vector<bool> held = held_vertices(body);
        std::vector<DeepVertex> deepest(surfaces.size());
        const double size = size_at_rest(resolved, body), near = body.material.thickness + kDeepShare * size;
        double far = 0;
        for (std::size_t v = 0; v < held.size(); ++v)
        {
            for (std::size_t c = 0; c < surfaces.size() && !held[v]; ++c)
                heights[c] = surfaces[c].touch(x[first + v], 0).height;
            if (!held[v])
                take(heights, near, v, deepest);
            far = std::max(far, glm::length(x[first + v]));
        }
        for (std::size_t c = 0; c < deepest.size(); ++c)
            if (deepest[c].depth > 0)
                out.push_back({b, c, deepest[c].depth, deepest[c].roomy, deepest[c].vertex, size,
                               rounded_way(Precision::float32, far)});
        first += held.size();
    }
    return out;
}

Soundness judge_depth(const Scene& resolved, std::span<const DeepVertex> deep)
{
    const auto worst = std::max_element(deep.begin(), deep.end(), [](const auto& a, const auto& b) {
        return excess(a, a.roomy) < excess(b, b.roomy);
    });
    Soundness out;
    if (worst == deep.end() || !(excess(*worst, worst->roomy) > 0))
        return out;
    out.status = Status::unconverged;
    out.reason = "vertex " + std::to_string(worst->vertex) + " of " +
                 called("bodies", worst->body, resolved.bodies[worst->body].name) + " ends " +
                 how_deep(resolved, *worst, worst->roomy) +
                 ", which is to keep it out; let it start outside, or take more substeps";
    return out;
}

std::vector<SceneIssue> deep_start_issues(const Scene& resolved)
{
    std::vector<glm::dvec3> start;
    for (const Body& body : resolved.bodies)
        start.insert(start.end(), start_of(body).begin(), start_of(body).end());
    std::vector<SceneIssue> out;
    for (const DeepVertex& deep : deep_vertices(resolved, start, 0))
        if (excess(deep, deep.depth) > 0)
            out.push_back({false, called("bodies", deep.body, ""),
                           "starts up to " + how_deep(resolved, deep, deep.depth) +
                               "; it is let out at no more than depenetration_speed, " +
                               shown(resolved.depenetration_speed, 3) + " m/s; let it start outside"});
    return out;
}

} // namespace taut
