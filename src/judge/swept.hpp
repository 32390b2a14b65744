#pragma once
// What passes through what between two frames, if vertices go straight from one to the other.
// Based on: Provot 1997, "Collision and Self-Collision Handling in Cloth Model Dedicated to Design Garments":
// four points that move straight are in one plane at the roots of a cubic.
// Departures: roots are enclosed between the extrema of the cubic and bisected; a slack of 1e-9 of the
// features keeps what passes through a common edge of two triangles from being missed by both.

#include "taut/judge/surface.hpp"

#include <glm/vec3.hpp>

namespace taut::judging {

/// A vertex and a triangle, or two edges, that meet on the way.
struct Passing
{
    bool edges = false;  ///< two edges; else a vertex and a triangle
    std::uint32_t a = 0; ///< vertex, or edge of Surface::edges
    std::uint32_t b = 0; ///< triangle, or edge
    double time = 0;     ///< of the way, 0 to 1
};

/// All of them without a common vertex, vertices first. In double precision: what only grazes may be missed
/// or reported. What is in one plane all the way is left out.
std::vector<Passing> passing_pairs(const Surface& surface, const std::vector<glm::dvec3>& before,
                                   const std::vector<glm::dvec3>& after);

} // namespace taut::judging
