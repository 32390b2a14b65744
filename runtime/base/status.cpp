#include "taut/runtime/base/status.hpp"

namespace taut {

std::string_view to_string(Status status)
{
    switch (status)
    {
    case Status::completed: return "completed";
    case Status::interrupted: return "interrupted";
    case Status::diverged: return "diverged";
    case Status::unconverged: return "unconverged";
    case Status::non_finite: return "non_finite";
    case Status::converged: return "converged";
    case Status::iteration_limit: return "iteration_limit";
    case Status::stagnated: return "stagnated";
    case Status::indefinite_matrix: return "indefinite_matrix";
    case Status::indefinite_preconditioner: return "indefinite_preconditioner";
    case Status::zero_right_hand_side: return "zero_right_hand_side";
    }
    return "unknown";
}

} // namespace taut
