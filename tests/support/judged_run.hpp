#pragma once
// The scenes of examples/contact, run step by step under the eyes of the judge, which shares nothing with the
// kernels.

#include "support/devices.hpp"

#include "taut/judge/judge.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <string>

namespace taut {

/// `name`: of a file, without its extension.
inline Scene suite(const std::string& name)
{
    return load_scene(TAUT_SOURCE_DIR "/examples/contact/" + name + ".json");
}

/// A world on one thread that is judged after each step.
struct JudgedRun
{
    World world;
    judging::SceneTriangles all = judging::scene_triangles(world.scene());
    judging::Judge judge{all.triangles, world.positions(), all.led};
    std::vector<glm::dvec3> before = world.positions();
    double nearest_parts = 1;    ///< m: the least distance of different parts so far
    std::size_t intersected = 0; ///< steps that end with something going through something
    std::size_t crossed = 0;     ///< the same, or something has passed on straight ways from the step before
    judging::FrameVerdict verdict; ///< of the last step

    explicit JudgedRun(const Scene& scene) : world(scene, test_device("cpu:serial")) {}

    void run(
        double until, const std::function<void()>& look = [] {})
    {
        while (world.time() < until - 1e-9)
        {
            world.step();
            std::vector<glm::dvec3> now = world.positions();
            verdict = judge.look(now);
            nearest_parts = std::min(nearest_parts, verdict.nearest_parts.distance);
            intersected += verdict.intersecting > 0;
            crossed += verdict.intersecting > 0 || !judge.between(before, now).empty();
            before = std::move(now);
            look();
        }
    }
    std::vector<glm::dvec3> body(std::size_t b) const
    {
        const auto& first = world.plan().body_start;
        return {before.begin() + first[b], before.begin() + first[b + 1]};
    }
    glm::dvec3 centre(std::size_t b) const
    {
        glm::dvec3 sum(0);
        for (const glm::dvec3& x : body(b))
            sum += x;
        return sum / static_cast<double>(body(b).size());
    }
};

/// m, along y.
inline double highest(const std::vector<glm::dvec3>& places)
{
    double out = -1e300;
    for (const glm::dvec3& x : places)
        out = std::max(out, x.y);
    return out;
}

/// kg, of a grid of cloth.
inline double sheet_mass(const Scene& resolved, std::size_t b)
{
    const auto& m = resolved.bodies[b];
    return m.material.density * m.shape.size.x * m.shape.size.y;
}

/// kg, of tetrahedra.
inline double solid_mass(const Scene& resolved, std::size_t b)
{
    const Body& body = resolved.bodies[b];
    const auto& x = body.mesh.positions;
    double volume = 0;
    for (const auto& t : body.mesh.tetrahedra)
        volume += glm::dot(x[t[1]] - x[t[0]], glm::cross(x[t[2]] - x[t[0]], x[t[3]] - x[t[0]])) / 6;
    return body.material.density * volume;
}

/// Of bodies a < b; null where they do not touch.
inline const BodyContactForce* force_between(const std::vector<BodyContactForce>& all, std::uint32_t a,
                                             std::uint32_t b)
{
    for (const BodyContactForce& f : all)
        if (f.a == a && f.b == b)
            return &f;
    return nullptr;
}

} // namespace taut
