#pragma once
// What remains of the way of a body that stands on a narrow patch without its rolling about that.

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace taut {

/// All of the vertices of a body.
struct BodyWay
{
    std::span<const glm::dvec3> place; ///< m, of each vertex at the start
    std::span<const glm::dvec3> way;   ///< m
    std::span<const double> mass;      ///< kg
    std::vector<bool> held;            ///< touches, and stays where it is
};

/// m: the ways without the rotation about the held vertices that comes closest to them (by mass, least
/// squares): about their middle, or, where they lie along a line, about that line. As they are where the held
/// vertices are a third of the body's size apart (root mean squares), or none is held.
std::vector<glm::dvec3> without_rolling(const BodyWay& body);

} // namespace taut
