// How many iterations a substep takes where a scene names none.
//
// Based on: Newton's method moves every vertex along a straight line in a step, so that what turns by an
//   angle a in a substep ends off its circle by a^2/2 of its length; the second step corrects that.
// Departures: two steps are taken only where springs are stiff enough to take that length back within a
//   substep: as motion along themselves, which is lost to the turn. Measured in docs/methods.md.

#include "taut/scene/body_measures.hpp"
#include "taut/scene/chain_waves.hpp"
#include "taut/scene/substeps.hpp"

#include <algorithm>

namespace taut {
namespace {

/// Whether waves of cloth or of a chain run over more than an edge in a substep. One Newton step makes such
/// a body longer where it turns, by half the square of the angle, and what draws it short again is lost.
bool turns_under_tension(const Body& body, double substep)
{
    if (body.kinematic.used || !body.mesh.tetrahedra.empty())
        return false;
    const double edge = sweep_load(body).edge;
    const double rate = edge > 0 ? wave_speed_squared(body) / (edge * edge) : 0;
    return std::max(rate, chain_waves(body)) * substep * substep > 1;
}

} // namespace

std::uint32_t automatic_iterations(const Scene& scene)
{
    if (scene.method.type != MethodKind::implicit_euler)
        return 1;
    const std::uint32_t substeps = scene.method.substeps;
    const double h = scene.timestep / (substeps > 0 ? substeps : automatic_substeps(scene));
    return std::ranges::any_of(scene.bodies, [&](const Body& b) { return turns_under_tension(b, h); }) ? 2
                                                                                                       : 1;
}

void count_steps(Scene& scene)
{
    if (scene.method.substeps == 0)
        scene.method.substeps = automatic_substeps(scene);
    if (scene.method.iterations == 0)
        scene.method.iterations = automatic_iterations(scene);
}

} // namespace taut
