#include "taut/judge/scene_triangles.hpp"

namespace taut::judging {

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
    return out;
}

} // namespace taut::judging
