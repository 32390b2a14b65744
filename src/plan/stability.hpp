#pragma once
// How long a step an explicit method may take: bounds on the fastest motion that springs, dampers and hinges
// can make. The plan and the references of src/report both call this.

#include "taut/plan/material.hpp"
#include "taut/plan/methods.hpp"

#include <array>
#include <span>
#include <vector>

namespace taut {

/// Whether a method moves a spring by its force; implicit_constraints does not where it is a constraint.
bool acts_as_force(const Scene& scene, const StretchElement& spring);

/// Sizes of the gradients of a hinge's angle at its corners (both ends of the edge, both wings), 1/m; zeros
/// without an angle. Indexes `x` [m].
std::array<double, 4> hinge_gradient_sizes(const BendElement& hinge, std::span<const glm::dvec3> x);

/// Bounds (Gershgorin, by rows) on the largest eigenvalues of M^-1 K and M^-1 D over the vertices that move.
struct RateBounds
{
    double stiffness = 0; ///< 1/s^2; infinite with rigid elements
    double damping = 0;   ///< 1/s
};

/// Row sums of |K|, N/m, one a vertex: what rate_bounds divides by the masses. Springs and hinges as there.
std::vector<double> stiffness_rows(const std::vector<StretchElement>& springs,
                                   const std::vector<BendElement>& hinges, std::size_t vertices,
                                   std::span<const glm::dvec3> x);

/// Springs count at their stiffest (along their direction; no shorter than half their rest length, where the
/// compressed direction across would be stiffer), hinges by their gradients at `x`; those without an area
/// there count nothing. Elements index `mass` [kg], `held` and `x` [m]. `more`: row sums of |K| of other
/// elements, N/m, none or one a vertex.
RateBounds rate_bounds(const std::vector<StretchElement>& springs, const std::vector<BendElement>& hinges,
                       const std::vector<double>& mass, const std::vector<bool>& held,
                       std::span<const glm::dvec3> x, std::span<const double> more = {});

/// The same over all bodies of a resolved scene, with elements that the program has added, at rest and at the
/// start: the larger. Elements that grow stiffer as they move are not foreseen.
RateBounds rate_bounds(const Scene& resolved);

/// Longest step, s, with which semi-implicit Euler and velocity Verlet stay bounded:
/// h^2 stiffness + 2 h damping = 4. Infinite where nothing pulls.
double stable_step(const RateBounds& rates);

/// Share of stable_step that a plan may use.
inline constexpr double kStableShare = 0.9;

/// The substeps of an explicit method by MethodSettings::stability. Throws Error{unstable_timestep}, with the
/// longest stable substep and how many would do.
Substeps stable_substeps(const Scene& resolved);

} // namespace taut
