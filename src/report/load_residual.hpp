#pragma once
// Whether bodies answer to their loads.

#include "taut/report/model.hpp"

#include <span>
#include <vector>

namespace taut {

/// What a substep of an implicit method left at each vertex, scene-wide.
struct Leftover
{
    std::vector<glm::dvec3> force; ///< N: M (x - x~) / h^2 - f(x)
    std::vector<double> load;      ///< N: mass times the larger of gravity and |(x - x~) / h^2|
    std::vector<bool> touches;     ///< something whose force is on no record: a collider, a limit
    double substep = 0;            ///< h, s, > 0
};

/// What one exact Newton step d would still move of a body's mass, over what its loads move in a substep:
/// sum m |d| / (h^2 sum l) over its free vertices, with (M / h^2 + K) d = -r, K made positive semidefinite
/// element by element; that of the worst body. 0 solved, 1 as if nothing pulled. Vertices that touch stay
/// where they are; of bodies that have any, half of what goes along gravity is counted alone: contacts push
/// after the solve, and what rests on them has yet to follow. -1 without a free vertex. Infinite where the
/// step is not finite. Models of more than 10,000 free vertices (of solids: 2,000) are solved by conjugate
/// gradients that may end early, which understates (their iterates grow).
double load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left);

} // namespace taut
