#pragma once
// How a run or a solve ended: one closed list for all methods (docs/statuses.md).

#include <string_view>

namespace taut {

enum class Status
{
    completed,       ///< the run reached its end with finite state
    interrupted,     ///< the user stopped it; what is done is sound
    diverged,        ///< energy from nowhere, or a state beyond bounds
    unconverged,     ///< not solved as asked: strain or residual beyond what the scene accepts
    non_finite,      ///< a value that is not finite appeared; the last finite state is kept
    converged,       ///< the true residual is within the tolerance
    iteration_limit, ///< the allowed iterations did not suffice
    stagnated,       ///< the residual no longer falls, above the tolerance
    indefinite_matrix,         ///< a direction of negative curvature was met
    indefinite_preconditioner, ///< r.M^-1 r was not positive
    zero_right_hand_side,      ///< nothing to solve; the answer is zero
};

/// The word for a status, as reports print it ("iteration_limit").
std::string_view to_string(Status status);

} // namespace taut
