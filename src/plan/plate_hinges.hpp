#pragma once
// Bending of a plate by hinges that know of each other: each triangle's compliance against turns at its
// edges.

#include "taut/plan/material.hpp"

#include <array>
#include <vector>

namespace taut {

/// One hinge of a body whose bending model is a plate. Sides: 0 the triangle of wing0, 1 that of wing1. The
/// energy of all is 1/2 (theta - rest)^T A^-1 (theta - rest), theta the angles; A has `softness` on its
/// diagonal and `coupling` beside it.
struct PlateHinge
{
    /// Rest angle, and the compliance of a bound on the energy from above: the sum over both sides of
    /// 1 / (mu K_ee), K the stiffness of the side's triangle, mu the largest eigenvalue of K scaled to a unit
    /// diagonal.
    BendElement element;
    double share = 0.5; ///< of side 0 in that compliance
    /// k0, k1, k2 of each side: -(K b)_e / (mu K_ee) + b_e as factors of b_e and of the triangle's other
    /// edges.
    std::array<std::array<double, 3>, 2> pull{};
    /// 2 * hinge + side of the triangle's other edges, two for each side; this hinge's own where there is
    /// none.
    std::array<std::uint32_t, 4> neighbour{};
    double softness = 0;              ///< rad^2/J, > 0
    std::array<double, 4> coupling{}; ///< rad^2/J, with the hinges neighbour / 2
};

/// Whether the body bends as a plate.
bool is_plate(const Body& body);

/// Of a resolved body that does, in the order of mesh_hinges. Left out are hinges with a zero edge or a
/// zero-area triangle at rest, which are counted in `dropped`, and those between triangles whose corners are
/// all held: such triangles cannot curve and have no compliance. Throws Error{unsupported} naming an edge of
/// more than two triangles.
std::vector<PlateHinge> plate_hinges(const Body& body, std::size_t* dropped = nullptr);

} // namespace taut
