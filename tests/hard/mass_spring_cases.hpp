#pragma once
// What the hard cases of mass-spring share.

#include "hard/cases.hpp"

namespace taut::hard {

inline Scene by_springs(Scene scene, std::uint32_t substeps = 20)
{
    scene.method.type = MethodKind::mass_spring;
    scene.method.substeps = substeps;
    return scene;
}

/// m = 1 kg on k = 1000 N/m, 0.1 m off; its stable step is 2 / sqrt(1000) = 0.0632456 s.
inline Scene oscillator(double h, const char* integrator = "semi_implicit")
{
    Body body = particles({{0, 0, 0}, {0.1, 0, 0}});
    body.springs = {{0, 1, 0, 1e-3}};
    body.pins = {hold({0})};
    Scene scene = by_springs(alone(body), 1);
    scene.timestep = h;
    scene.method.integrator = option_named<Integrator>(integrator);
    scene.method.stability = StabilityRule::ignore;
    return scene;
}

constexpr double kLimit = 0.06324555320336758;

/// What symplectic Euler keeps (methods A01): v^2/2 + k x^2/2 - h k x v/2.
inline double kept_by_euler(const World& world)
{
    const double x = world.positions()[1].x, v = world.velocities()[1].x;
    return v * v / 2 + 500 * x * x - world.plan().timestep * 500 * x * v;
}

} // namespace taut::hard
