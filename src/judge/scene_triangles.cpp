#include "taut/judge/scene_triangles.hpp"

#include <algorithm>

namespace taut::judging {
namespace {

/// Bodies that say the same are of one kind.
PassingBodies passing_bodies(const Scene& scene, const std::vector<std::uint32_t>& body)
{
    PassingBodies out;
    std::vector<BodyContact> kinds;
    for (const Body& b : scene.bodies)
    {
        const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const BodyContact& k) {
            return k.group == b.contact.group && k.passes == b.contact.passes;
        });
        out.kind.push_back(static_cast<std::uint32_t>(known - kinds.begin()));
        if (known == kinds.end())
            kinds.push_back(b.contact);
    }
    bool any = false;
    for (const BodyContact& a : kinds)
    {
        std::vector<bool>& row = out.passes.emplace_back();
        for (const BodyContact& b : kinds)
            row.push_back(pass_through(a, b));
        any = any || std::find(row.begin(), row.end(), true) != row.end();
    }
    if (any)
        out.body = body;
    return out;
}

} // namespace

SceneTriangles scene_triangles(const Scene& resolved)
{
    SceneTriangles out;
    for (std::uint32_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const auto first = static_cast<std::uint32_t>(out.body.size());
        const Mesh& mesh = resolved.bodies[b].mesh;
        for (const Triangle& t : mesh.triangles)
            out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        out.body.resize(out.body.size() + mesh.positions.size(), b);
        out.led.resize(out.body.size(), resolved.bodies[b].kinematic.used);
    }
    out.passing = passing_bodies(resolved, out.body);
    return out;
}

} // namespace taut::judging
