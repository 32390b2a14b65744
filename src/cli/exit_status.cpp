#include "taut/cli/exit_status.hpp"

namespace taut::cli {

bool sound(Status status)
{
    switch (status)
    {
    case Status::completed:
    case Status::interrupted:
    case Status::converged:
    case Status::zero_right_hand_side: return true;
    default: return false;
    }
}

Exit exit_status(Status status) { return sound(status) ? kDone : kNotSound; }

Exit exit_status(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::no_device: return kNoDevice;
    case ErrorCode::device_lost:
    case ErrorCode::out_of_memory: return kNotSound;
    default: return kBadInput;
    }
}

} // namespace taut::cli
