#pragma once
// Runs scenes of surfaces that are to meet, and counts where they cross, by src/judge.

#include "support/devices.hpp"

#include "taut/judge/crossings.hpp"
#include "taut/judge/judge.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace taut::test {

/// Pairs of features that met: in a frame, or on the straight ways between two.
struct Crossed
{
    std::size_t met = 0;
    ContactCounts counts;
};

/// The vertices of a scene, and which pairs of them count: of bodies that are to meet each other, or
/// themselves, and not all held.
struct Meant
{
    const Scene& scene;
    judging::SceneTriangles all = judging::scene_triangles(scene);
    std::vector<bool> held = std::vector<bool>(all.body.size(), false);

    explicit Meant(const Scene& of) : scene(of)
    {
        std::uint32_t first = 0;
        for (const Body& body : scene.bodies)
        {
            for (const Pin& pin : body.pins)
                for (const std::uint32_t v : pin.vertices)
                    held[first + v] = true;
            first += static_cast<std::uint32_t>(body.mesh.positions.size());
        }
    }
    template <typename A, typename B>
    bool operator()(const A& a, const B& b) const
    {
        const auto is_held = [&](std::uint32_t v) { return held[v]; };
        if (std::all_of(a.begin(), a.end(), is_held) && std::all_of(b.begin(), b.end(), is_held))
            return false;
        return surfaces_meet(scene, all.body[a[0]], all.body[b[0]]);
    }
};

inline std::size_t met_between(const Meant& meant, const judging::Judge& judge,
                               const std::vector<glm::dvec3>& before, const std::vector<glm::dvec3>& after)
{
    std::size_t met = 0;
    const judging::Surface& s = judge.surface();
    for (const judging::Passing& p : judge.between(before, after))
        met +=
            (p.edges ? meant(s.edges[p.a], s.edges[p.b]) : meant(std::array{p.a}, s.triangles[p.b])) ? 1 : 0;
    for (const auto& [t, u] : judging::intersecting_triangles(s, after))
        met += meant(s.triangles[t], s.triangles[u]) ? 1 : 0;
    return met;
}

/// Every step is one substep where `ways`: then ways are straight between frames.
inline Crossed run_thrown(const Scene& scene, int steps, bool ways, const std::string& device = "cpu:serial")
{
    World world(scene, test_device(device));
    const Meant meant(world.scene());
    std::vector<glm::dvec3> before = world.positions();
    const judging::Judge judge(meant.all.triangles, before);
    Crossed out;
    for (int step = 0; step < steps; ++step)
    {
        world.step();
        const std::vector<glm::dvec3> after = world.positions();
        out.met += met_between(meant, judge, ways ? before : after, after);
        before = after;
    }
    out.counts = world.contacts();
    return out;
}

} // namespace taut::test
