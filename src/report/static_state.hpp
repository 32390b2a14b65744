#pragma once
// What the parts of the static reference share: its number, its state, its two forms of second derivatives.

#include "taut/report/hinge.hpp"

#include <vector>

namespace taut::reference {

/// Long double, because at 1e6 N/m one fp64 rounding of a position is a force far above 1e-12 of the weight.
using Real = long double;
using State = std::vector<Vec<Real>>; ///< m or N, one a vertex, pinned ones too

/// Projected: positive semidefinite; the exact Hessian of cloth that is slack or folded is not.
enum class Curvature
{
    exact,
    projected
};

} // namespace taut::reference
