#pragma once
// Small pieces of SVG: numbers, escaped text, wrapped lines.

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace taut::svg_text {

/// Two decimals with a point, whatever the locale.
std::string fixed(double value);

/// For text and attributes. Characters that XML forbids become spaces.
std::string escaped(std::string_view text);

/// Broken at blanks so that no line is longer than `width` characters, if its words allow.
std::vector<std::string> wrapped(std::string_view text, std::size_t width);

struct TextStyle
{
    double size = 12;
    const char* anchor = "start"; ///< "start", "middle", "end"
    const char* fill = "#222";
    bool bold = false;
    double turn = 0;              ///< degrees about the point
};

/// One <text> element.
std::string text(double x, double y, std::string_view words, const TextStyle& style = {});
/// The same in white and bolder, to stand below it: lines end at the words.
std::string halo(double x, double y, std::string_view words, const TextStyle& style);
/// 10 with an exponent.
std::string power_of_ten(double x, double y, int exponent, const TextStyle& style);
std::string line(double x0, double y0, double x1, double y1, std::string_view stroke, double width);

/// Corners of a line, pixels.
using Path = std::vector<std::pair<double, double>>;
/// Empty for less than two corners. `style`: attributes.
std::string polyline(const Path& path, const std::string& style);

enum class Filling
{
    full,
    hollow,
    dotted ///< hollow with a point in its middle
};
/// Shapes that stand for themselves; from here on shapes are those of further variants.
inline constexpr std::size_t kShapes = 7, kMoreShapes = 3;
/// A shape of about `size` pixels across: 0 to kShapes + kMoreShapes - 1.
std::string marker(double x, double y, std::size_t shape, std::string_view colour, double size,
                   Filling filling = Filling::full);

} // namespace taut::svg_text
