#pragma once
// What the hard cases of vertex block descent share.

#include "hard/cases.hpp"

namespace taut::hard {

inline Scene by_vbd(Scene scene, std::uint32_t substeps = 10, std::uint32_t iterations = 2)
{
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return scene;
}

inline double centre_height(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    double sum = 0, mass = 0;
    const auto x = world.positions();
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        sum += model.mass[v] * x[v].y;
        mass += model.mass[v];
    }
    return sum / mass;
}

/// Largest |l - L| / L over the springs.
inline double largest_strain(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    const auto x = world.positions();
    double worst = 0;
    for (const StretchElement& s : model.springs)
        worst = std::max(worst, std::abs(glm::distance(x[s.a], x[s.b]) / s.rest_length - 1));
    return worst;
}

} // namespace taut::hard
