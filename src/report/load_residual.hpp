#pragma once
// Whether bodies as a whole answer to their loads.

#include "taut/report/model.hpp"

#include <span>
#include <vector>

namespace taut {

/// What a substep of an implicit method left at each vertex, scene-wide.
struct Leftover
{
    std::vector<glm::dvec3> force; ///< N: M (x - x~) / h^2 - f(x)
    std::vector<double> load;      ///< N: mass times the larger of gravity and |(x - x~) / h^2|
    std::vector<bool> touches;     ///< a collider, whose force is on no record
    double rounding = 0;           ///< m: of a coordinate
};

/// Of the worst body the larger of |sum r| / sum l and |sum d x r| / sum |d| l, with the leftover forces r
/// and the loads l of its free vertices and d from their centre of mass: 0 solved, 1 as if nothing pulled.
/// A sum that rounded places at held vertices explain counts as 0. Bodies of which a free vertex touches a
/// collider are left out; -1 where none is left.
double load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left);

} // namespace taut
