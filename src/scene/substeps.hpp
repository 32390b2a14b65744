#pragma once
// Internal to src/scene: the substeps that a scene takes when it names none.

#include "taut/scene/scene.hpp"

namespace taut {

inline constexpr std::uint32_t kLeastSubsteps = 10, kMostAutomaticSubsteps = 1000;
/// Strain that sweeps over constraints or vertices may leave under the scene's own weight.
inline constexpr double kSweepStrain = 0.01;

/// A body of a resolved scene as a method that sweeps sees it.
struct SweepLoad
{
    double vertices = 0; ///< masses of one vertex that hang from one constraint, at most
    double edge = 0;     ///< m, mean length
};
SweepLoad sweep_load(const Body& resolved);

} // namespace taut
