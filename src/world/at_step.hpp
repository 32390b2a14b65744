#pragma once
// Internal to src/world: velocities at the steps, from those that a world keeps.

#include "taut/plan/plan.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace taut {

/// How the velocities of a world stand.
struct Pace
{
    double substep = 0; ///< s
    glm::dvec3 gravity{0};
    double lead = -0.5; ///< Plan::velocity_lead

    bool operator==(const Pace&) const = default;
};

/// A vertex as kept: its velocity, and of the last substep the displacement and what that had been had
/// gravity alone acted (of methods that lead by 0 or more: without what acts after the guess).
struct Kept
{
    Pull pull = Pull::held;
    glm::dvec3 velocity, displacement, coasting;
};

/// The velocity at the step, m/s: that in the middle of the last substep and half the kick that acts. With
/// gravity alone outside that is g h / 2; else half of what the last substep showed, never more than gravity
/// or the integrator gives by itself, so that a blow is no acceleration.
glm::dvec3 velocity_at_step(const Pace& pace, const Kept& vertex);

/// The same of many, as buffers have them; that of vertex v stands at order[v] - first of the result.
/// `coasting` may be `displacement` itself.
template <typename Real>
std::vector<glm::dvec3> velocities_at_step(const Pace& pace, std::span<const Pull> pull,
                                           std::span<const std::uint32_t> order, std::uint32_t first,
                                           std::span<const glm::vec<4, Real>> velocity,
                                           std::span<const glm::vec<4, Real>> displacement,
                                           std::span<const glm::vec<4, Real>> coasting);

/// The same vertex, with the same velocity at the step, where the next substep has another length or gravity.
Kept repaced(const Pace& before, const Pace& after, const Kept& vertex);

} // namespace taut
