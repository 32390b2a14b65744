#include "taut/scene/base64.hpp"

#include <cstdint>

namespace taut::scene_file {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

bool from_base64(std::string_view text, std::string& bytes)
{
    bytes.clear();
    std::uint32_t group = 0;
    int letters = 0, padding = 0;
    for (const char c : text)
    {
        if (c == ' ' || c == '\n' || c == '\t' || c == '\r')
            continue;
        const std::size_t value = c == '=' ? 0 : kLetters.find(c);
        padding += c == '=';
        if (value == std::string_view::npos || (c != '=' && padding > 0) || padding > 2)
            return false;
        group = group << 6 | static_cast<std::uint32_t>(value);
        if (++letters < 4)
            continue;
        for (int b = 0; b < 3 - padding; ++b)
            bytes += static_cast<char>(group >> (16 - 8 * b) & 0xffu);
        group = 0;
        letters = padding = 0;
    }
    return letters == 0;
}

} // namespace taut::scene_file
