#pragma once
// Internal to src/report: Newton steps of scenes too large to factor.

#include "taut/report/load_residual.hpp"
#include "taut/report/static_energy.hpp"

#include <span>
#include <vector>

namespace taut {

/// m, a vertex: (M / t^2 + K) d = f for each of `forces` [N, a vertex], t = left.time, vertices that touch
/// held. Ends when the rest of the way is at most kStepError of what each body moves, sum m |d|, as far as
/// the last iterations show; of the first force, what is left, also when it is at most kStepFloor of what
/// the body's loads move (forces 1 and on, else free of everything). Or after kMostStepIterations.
std::vector<std::vector<glm::dvec3>> iterated_steps(const PhysicalModel& model,
                                                    const reference::StaticEnergy& energy,
                                                    std::span<const glm::dvec3> x, const Leftover& left,
                                                    const std::vector<std::vector<glm::dvec3>>& forces);

inline constexpr double kStepError = 0.01, kStepFloor = 0.002;
inline constexpr int kMostStepIterations = 300;

} // namespace taut
