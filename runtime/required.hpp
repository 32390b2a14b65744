#pragma once
// What every class that works on a device asks first.

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/device.hpp"

#include <string>
#include <string_view>

namespace taut {

/// `device`, if there is one; `who` names what was to work on it. Throws Error{bad_input}.
inline std::shared_ptr<Device> required(std::shared_ptr<Device> device, std::string_view who)
{
    if (!device)
        throw Error(ErrorCode::bad_input,
                    std::string(who) + " was given no device; give one that Device::open returned");
    return device;
}

} // namespace taut
