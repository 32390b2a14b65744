// Based on: a wave along springs k between masses m runs sqrt(k / m) edges in a second.
// Departures: springs and masses of one body differ, and a spring swings by the mean of what its ends weigh:
//   k (w_a + w_b) / 2, of which the mean is taken. The ends of a chain weigh half, and what is held does not
//   give way, so that the mean over a uniform one is that of its middle. Rigid springs carry no waves.

#include "taut/scene/chain_waves.hpp"

#include "taut/scene/extent.hpp"
#include "taut/scene/held.hpp"
#include "taut/scene/pose.hpp"
#include "taut/scene/substeps.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace taut {
namespace {

/// kg of each vertex; 0 where only the plan can tell, which knows what no link is at.
std::vector<double> masses_of(const Body& body)
{
    if (!body.vertex_masses.empty())
        return body.vertex_masses;
    const Mesh& mesh = body.mesh;
    std::vector<double> out(mesh.positions.size(), 0.0);
    for (const auto& [a, b] : mesh.links)
    {
        const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
        const double half = 0.5 * body.material.density * length * mesh.link_width;
        out[a] += half;
        out[b] += half;
    }
    return out;
}

bool is_driven(const Scene& scene, const Body& body)
{
    const auto moves = [](const auto& held) { return !held.motion.empty() || held.moved_by_program; };
    return scene.external_forces || glm::length(body.velocity) > 0 || std::ranges::any_of(body.pins, moves) ||
           std::ranges::any_of(scene.colliders, moves);
}

} // namespace

double chain_waves(const Body& body)
{
    const Mesh& mesh = body.mesh;
    if (!mesh.triangles.empty() || !mesh.tetrahedra.empty())
        return 0;
    const std::vector<double> masses = masses_of(body);
    const std::vector<bool> held = held_vertices(body);
    const auto gives = [&](std::uint32_t v) { return held[v] || !(masses[v] > 0) ? 0 : 1 / masses[v]; };
    double sum = 0, count = 0;
    const auto take = [&](std::uint32_t a, std::uint32_t b, double stiffness) {
        const double rate = stiffness * (gives(a) + gives(b)) / 2;
        if (!(stiffness > 0) || !std::isfinite(rate))
            return;
        sum += rate;
        ++count;
    };
    const double modulus = body.material.stretch_stiffness * mesh.link_width; // N
    for (const auto& [a, b] : mesh.links)
        take(a, b, modulus / glm::distance(mesh.positions[a], mesh.positions[b]));
    for (const Body::Spring& spring : body.springs)
        take(spring.a, spring.b, 1 / spring.compliance);
    return count > 0 ? sum / count : 0;
}

bool hangs_still(const Scene& scene, const Body& body)
{
    if (is_driven(scene, body))
        return false;
    const double g = glm::length(scene.gravity);
    if (!(g > 0))
        return body.start_positions.empty();
    const glm::dvec3 down = scene.gravity / g;
    const std::vector<glm::dvec3>& start = start_of(body);
    Extent all, beside;                     // the second without what lies along gravity
    double pins = HUGE_VAL, top = HUGE_VAL; // m along gravity
    for (const glm::dvec3& x : start)
    {
        const double below = glm::dot(x, down);
        all.take(x);
        beside.take(x - below * down);
        top = std::min(top, below);
    }
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            pins = std::min(pins, glm::dot(start[v], down));
    return beside.size() <= kSeenWay * all.size() && pins - top <= kSeenWay * all.size();
}

} // namespace taut
