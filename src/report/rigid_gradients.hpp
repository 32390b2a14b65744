#pragma once
// Conjugate gradients for the stiffness of a whole scene on the host.

#include "taut/report/block_matrix.hpp"
#include "taut/report/rigid_coarse.hpp"

#include <functional>

namespace taut::reference {

/// Of the iterate after every kIterationsALook iterations, the start at first: whether it is near enough.
using Settled = std::function<bool(const Columns& x)>;
inline constexpr int kIterationsALook = 5;

/// Solves A x = b until `settled` says so, or until `most` iterations are done.
class RigidGradients
{
public:
    /// A is positive definite and outlives the solver; place [m] of each vertex.
    RigidGradients(const BlockMatrix& a, const Columns& place, std::uint32_t group_size);

    Columns solve(const Columns& b, const Settled& settled, int most) const;

private:
    Columns precondition(const Columns& r) const;

    const BlockMatrix& a_;
    RigidCoarse coarse_;
    std::vector<Eigen::Matrix3d> inverse_; ///< of the diagonal
};

} // namespace taut::reference
