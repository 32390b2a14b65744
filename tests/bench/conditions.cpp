#include "conditions.hpp"

#include "taut/runtime/device.hpp"
#include "taut/version.hpp"

#include <charconv>
#include <cstring>
#include <stdexcept>
#include <utility>

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

std::vector<std::uint32_t> sides(int argc, char** argv, int first, std::vector<std::uint32_t> otherwise)
{
    std::vector<std::uint32_t> out;
    for (int k = first; k < argc; ++k)
    {
        std::uint32_t n = 0;
        const char* end = argv[k] + std::strlen(argv[k]);
        const auto [stop, code] = std::from_chars(argv[k], end, n);
        if (code != std::errc() || stop != end || n < 2 || n > 512)
            throw std::runtime_error("\"" + std::string(argv[k]) +
                                     "\" is no number of vertices a side; write 2 to 512");
        out.push_back(n);
    }
    return out.empty() ? std::move(otherwise) : out;
}

} // namespace bench
