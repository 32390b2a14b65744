#pragma once
// Which second derivatives of an energy are meant.

namespace taut::reference {

/// Projected: positive semidefinite; the exact Hessian of cloth that is slack or folded is not. Elastic: that
/// without what tension adds across springs, links and triangles, which turns them and strains nothing.
enum class Curvature
{
    exact,
    projected,
    elastic
};

} // namespace taut::reference
