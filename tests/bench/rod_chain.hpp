#pragma once
// The exact motion of a chain of rigid rods, apart from anything that is measured against it.
//
// Based on: equations of motion with Lagrange multipliers, m a_k = m g + T_{k+1} u_{k+1} - T_k u_k, where the
// tensions T of the rods follow from u_k . (a_k - a_{k-1}) = -|v_k - v_{k-1}|^2 / L: a symmetric tridiagonal
// system. Runge-Kutta of order four.

#include <glm/vec2.hpp>

#include <vector>

namespace bench {

/// `rods` rods of `length` m between equal point masses, the first of which is held at the origin; they start
/// straight along x, at rest, under gravity along -y. Returns the places of all rods + 1 masses after `time`
/// s, by steps of at most `step` s. Double precision; rods stay as long as they are to the error of the
/// integration.
std::vector<glm::dvec2> fallen_chain(int rods, double length, double time, double step);

} // namespace bench
