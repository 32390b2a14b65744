#include "taut/cli/numbers.hpp"

#include "taut/runtime/base/shown.hpp"

#include <charconv>
#include <cmath>

namespace taut::cli {
namespace {

constexpr const char* kIs = "is \"";

/// The whole text as a number; false where it is none, or one that does not fit.
template <class Number>
bool read(const std::string& text, Number& value)
{
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end;
}

CLI::Validator check(const std::string& wanted, const std::function<bool(const std::string&)>& right)
{
    return {[=](std::string& text) {
                return right(text) ? std::string() : kIs + text + "\"; it must be " + wanted;
            },
            ""};
}

} // namespace

CLI::Validator whole_number(std::uint32_t least, std::uint32_t most)
{
    const std::string range = most == kAnyCount
                                  ? ", " + std::to_string(least) + " or more, up to " + std::to_string(most)
                                  : " from " + std::to_string(least) + " to " + std::to_string(most);
    return check("a whole number" + range, [=](const std::string& text) {
        std::uint32_t value = 0;
        return read(text, value) && value >= least && value <= most;
    });
}

CLI::Validator number_between(double least, double most, Ends ends, const std::string& hint)
{
    const bool open = ends == Ends::open;
    const std::string from = shown(least), to = shown(most);
    std::string range = " from " + from + " to " + to;
    if (!std::isfinite(most))
        range = open ? " above " + from : ", " + from + " or more";
    else if (open)
        range = " between " + from + " and " + to;
    return check("a number" + range + hint, [=](const std::string& text) {
        double value = 0;
        if (!read(text, value) || !std::isfinite(value))
            return false;
        return open ? value > least && value < most : value >= least && value <= most;
    });
}

std::string sentence(const CLI::ParseError& error)
{
    std::string text = error.what();
    const std::string mark = std::string(": ") + kIs;
    if (const std::size_t at = text.find(mark); at != std::string::npos)
        text.erase(at, 1); // "--frames: is" becomes "--frames is"
    return text;
}

} // namespace taut::cli
