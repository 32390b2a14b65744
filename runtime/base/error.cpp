#include "taut/runtime/base/error.hpp"

namespace taut {

std::string_view to_string(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::bad_input: return "bad_input";
    case ErrorCode::bad_timestep: return "bad_timestep";
    case ErrorCode::degenerate_rest: return "degenerate_rest";
    case ErrorCode::unsupported: return "unsupported";
    case ErrorCode::limit: return "limit";
    case ErrorCode::no_device: return "no_device";
    case ErrorCode::device_lost: return "device_lost";
    case ErrorCode::out_of_memory: return "out_of_memory";
    case ErrorCode::io: return "io";
    case ErrorCode::kernel_compilation: return "kernel_compilation";
    case ErrorCode::unstable_timestep: return "unstable_timestep";
    }
    return "unknown";
}

} // namespace taut
