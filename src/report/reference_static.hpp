#pragma once
// Reference R2: the static equilibrium of a model, by Newton with line search in fp64.

#include "taut/report/model.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace taut {

struct StaticOptions
{
    double tolerance = 1e-12;         ///< of |force|_inf, in units of the total weight
    /// Where rounding hides the weight behind the forces, a state counts as converged too when a whole Newton
    /// step would move nothing by more than this, in units of the way from the start. 0: forces alone count.
    double resolution = 1e-9;
    std::uint32_t iterations = 3000;  ///< factorisations at most
    /// From a saddle (a flat sheet under compression) go on to a stable state by a small nudge.
    bool leave_saddles = true;
};

/// Sound only when `converged`; else `reason` says why not, and the rest is the best state found.
struct StaticReference
{
    bool converged = false;
    bool stable = false;          ///< the Hessian at `positions` has no negative eigenvalue
    std::string reason;           ///< empty when converged and stable
    std::vector<glm::dvec3> positions; ///< m, all vertices
    double residual = 0;          ///< N, largest force component on a free vertex
    double relative_residual = 0; ///< residual over total weight (over the largest elastic force at the start
                                  ///< when nothing has weight)
    double correction = 0;        ///< m, largest component of a further Newton step; 0 when forces converged
    double energy = 0;            ///< J, elastic and gravity
    double largest_stretch = 0;   ///< (l - L)/L over springs with L > 0 and membranes, signed
    std::uint32_t iterations = 0;
};

/// Follows the model downhill from `start` (all vertices, m; pinned ones stay there) to a stable
/// equilibrium: damped implicit steps first, plain Newton at the end. Refuses, with a reason and the start
/// state: rigid elements, elements of a program's own, enclosed volumes and gases, colliders, slivers of
/// plates, and parts that no pin holds under gravity.
StaticReference solve_static(const PhysicalModel& model, const std::vector<glm::dvec3>& start,
                             const StaticOptions& options = {});

} // namespace taut
