#include "taut/world/crossed_start.hpp"

#include "taut/judge/crossings.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/scene/pose.hpp"

namespace taut {
namespace {

/// "triangle 12 of bodies[1] ("cloth")"
std::string name_of(const Scene& scene, std::uint32_t body, std::uint32_t triangle)
{
    for (std::uint32_t b = 0; b < body; ++b)
        triangle -= static_cast<std::uint32_t>(scene.bodies[b].mesh.triangles.size());
    const std::string& name = scene.bodies[body].name;
    return "triangle " + std::to_string(triangle) + " of bodies[" + std::to_string(body) + "]" +
           (name.empty() ? "" : " (\"" + name + "\")");
}

std::vector<glm::dvec3> places_at_start(const Scene& scene)
{
    std::vector<glm::dvec3> out;
    for (const Body& body : scene.bodies)
        out.insert(out.end(), start_of(body).begin(), start_of(body).end());
    return out;
}

} // namespace

std::string crossed_at_start(const Scene& resolved)
{
    if (!wants_contact(resolved))
        return {};
    judging::SceneTriangles all = judging::scene_triangles(resolved);
    const std::vector<std::uint32_t> body = std::move(all.body);
    const judging::Surface surface =
        judging::make_surface(body.size(), std::move(all.triangles), std::move(all.led));
    std::size_t count = 0;
    std::string first;
    for (const auto& [s, t] : judging::intersecting_triangles(surface, places_at_start(resolved)))
    {
        const std::uint32_t a = body[surface.triangles[s][0]], b = body[surface.triangles[t][0]];
        if (!surfaces_meet(resolved, a, b))
            continue;
        if (count++ == 0)
            first = name_of(resolved, a, s) + " and " + name_of(resolved, b, t);
    }
    if (count == 0)
        return {};
    return "surfaces that are to meet go through each other at the start: " + std::to_string(count) +
           (count == 1 ? " pair of triangles, " : " pairs of triangles, the first ") + first +
           "; move the bodies apart, or set contact.start to \"ignore\"";
}

} // namespace taut
