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

std::string shown_percent(double share, int digits) { return shown(100 * share, digits) + " %"; }

std::string counted(std::uint64_t count, std::string_view one, std::string_view several)
{
    return std::to_string(count) + ' ' + std::string(count == 1 ? one : several);
}

} // namespace taut
