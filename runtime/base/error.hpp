#pragma once
// The one exception type of the library and its closed list of codes.

#include <stdexcept>
#include <string>
#include <string_view>

namespace taut {

/// Why an operation was refused. The list is closed; docs/statuses.md explains each word.
enum class ErrorCode
{
    bad_input,          ///< a value, index or field of the caller is wrong
    bad_timestep,       ///< time step zero, negative, not finite or absurdly large
    degenerate_rest,    ///< zero rest length, area or volume where the method divides by it
    unsupported,        ///< asked for something that this build, device or method does not have
    limit,              ///< a limit of the device is exceeded
    no_device,          ///< no device matches the selector
    device_lost,        ///< the device failed while it worked
    out_of_memory,      ///< the host or the device has no room left
    io,                 ///< a file could not be read or written
    kernel_compilation, ///< a kernel text does not compile
    unstable_timestep,  ///< longer than the stiffness allows an explicit method
};

/// The word for a code, as reports and messages print it ("bad_input").
std::string_view to_string(ErrorCode code);

/// Thrown when the outside world fails. what() is one sentence that says what to try.
class Error : public std::runtime_error
{
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ErrorCode code() const { return code_; }

private:
    ErrorCode code_;
};

} // namespace taut
