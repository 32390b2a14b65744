#include "conditions.hpp"

#include "taut/runtime/device.hpp"
#include "taut/version.hpp"

namespace bench {

std::string processor() { return taut::Device::open("cpu:serial")->info().name; }

std::string conditions(const std::string& program, int argc, char** argv)
{
    std::string text = "taut " TAUT_VERSION "; devices:";
    for (const taut::DeviceInfo& device : taut::Device::list())
        text += " " + device.selector + " = " + device.name + " (" + device.driver + "),";
    text.back() = ';';
#if defined(__clang__)
    text += " compiler: clang " __clang_version__;
#else
    text += " compiler: g++ " __VERSION__;
#endif
    text += "; CPU: " + processor() + "; command: " + program; // not the folder that it lies in
    for (int i = 1; i < argc; ++i)
        text += std::string(" ") + argv[i];
    return text;
}

} // namespace bench
