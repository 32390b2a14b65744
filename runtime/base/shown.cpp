#include "taut/runtime/base/shown.hpp"

#include <charconv>

namespace taut {

std::string shown(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string shown(double value, int digits)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
}

} // namespace taut
