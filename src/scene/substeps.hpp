#pragma once
// Internal to src/scene: the substeps that a scene takes when it names none.

#include "taut/scene/scene.hpp"

namespace taut {

inline constexpr std::uint32_t kLeastSubsteps = 10;
/// Strain that sweeps over constraints or vertices may leave under the scene's own loads.
inline constexpr double kSweepStrain = 0.01;
/// A hundredth of a body's size is where somebody sees that it hangs elsewhere.
inline constexpr double kSeenWay = 0.01;

/// A body of a resolved scene as a method that sweeps sees it.
struct SweepLoad
{
    double vertices = 0; ///< masses of one vertex that hang from one constraint, at most
    double edge = 0;     ///< m, mean length
    double length = 0;   ///< m, straight from what is furthest, by edges, to the nearest pin; 0 without pins
    std::uint32_t reach = 0; ///< edges from the pins, or from one end, to what is furthest
};
SweepLoad sweep_load(const Body& resolved);

/// What the solids of a scene ask for that are held or can meet something, whatever it names and without the
/// least that there are; 0 without such solids. Of methods that sweep, and implicit_euler.
double substeps_of_solids(const Scene& resolved);

/// Whether pins on all sides carry a body across a push, of gravity or the wind, as a hammock or a sail: then
/// strain shows as its root. A push of 0 spans nothing.
bool is_spanned(const Body& resolved, const glm::dvec3& push);

} // namespace taut
