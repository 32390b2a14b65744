#include "taut/report/svg_text.hpp"

#include <charconv>
#include <cmath>

namespace taut::svg_text {

std::string fixed(double value)
{
    char buffer[64];
    const double tidy = std::abs(value) < 0.005 ? 0.0 : value; // no "-0.00"
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, tidy, std::chars_format::fixed, 2).ptr;
    return {buffer, end};
}

std::string escaped(std::string_view text)
{
    std::string out;
    for (char c : text)
        switch (c)
        {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '"': out += "&quot;"; break;
        default: out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    return out;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width)
{
    std::vector<std::string> out(1);
    while (!text.empty())
    {
        const std::size_t blank = text.find(' ');
        const std::string_view word = text.substr(0, blank);
        if (!out.back().empty() && out.back().size() + 1 + word.size() > width)
            out.emplace_back();
        else if (!out.back().empty())
            out.back() += ' ';
        out.back() += word;
        text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
    }
    return out;
}

static std::string opening(double x, double y, const TextStyle& style, const char* more = "")
{
    std::string out = "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" font-size=\"" + fixed(style.size) +
                      "\" text-anchor=\"" + style.anchor + "\" fill=\"" + style.fill + "\"";
    if (style.bold)
        out += " font-weight=\"bold\"";
    if (style.turn != 0)
        out += " transform=\"rotate(" + fixed(style.turn) + " " + fixed(x) + " " + fixed(y) + ")\"";
    return out + more + ">";
}

std::string text(double x, double y, std::string_view words, const TextStyle& style)
{
    return opening(x, y, style) + escaped(words) + "</text>\n";
}

// An element of its own: viewers that do not know paint-order (those of Cairo) would draw a white edge of the
// text itself over its letters.
std::string halo(double x, double y, std::string_view words, const TextStyle& style)
{
    TextStyle white = style;
    white.fill = "#fff";
    constexpr const char* kEdge =
        " stroke=\"#fff\" stroke-width=\"2.50\" stroke-linejoin=\"round\" aria-hidden=\"true\"";
    return opening(x, y, white, kEdge) + escaped(words) + "</text>\n";
}

std::string power_of_ten(double x, double y, int exponent, const TextStyle& style)
{
    // U+2212, the minus sign.
    const std::string digits = (exponent < 0 ? "\xE2\x88\x92" : "") + std::to_string(std::abs(exponent));
    return opening(x, y, style) + "10<tspan dy=\"-5\" font-size=\"" + fixed(0.75 * style.size) + "\">" +
           digits + "</tspan></text>\n";
}

std::string line(double x0, double y0, double x1, double y1, std::string_view stroke, double width)
{
    return "<line x1=\"" + fixed(x0) + "\" y1=\"" + fixed(y0) + "\" x2=\"" + fixed(x1) + "\" y2=\"" +
           fixed(y1) + "\" stroke=\"" + std::string(stroke) + "\" stroke-width=\"" + fixed(width) + "\"/>\n";
}

std::string polyline(const Path& path, const std::string& style)
{
    if (path.size() < 2)
        return "";
    std::string points;
    for (const auto& [x, y] : path)
        points += (points.empty() ? "" : " ") + fixed(x) + "," + fixed(y);
    return "<polyline points=\"" + points + "\" fill=\"none\" " + style + "/>\n";
}

namespace {

/// Corners of the shapes beside the circle, in units of half the size.
std::vector<std::pair<double, double>> shape_corners(std::size_t shape)
{
    switch (shape)
    {
    case 1: return {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
    case 2: return {{0, -1.1}, {1.05, 0.8}, {-1.05, 0.8}};
    case 3: return {{0, -1.2}, {1.2, 0}, {0, 1.2}, {-1.2, 0}};
    case 4: return {{0, 1.1}, {1.05, -0.8}, {-1.05, -0.8}};
    case 6: return {{-1.1, 0}, {-0.5, -1}, {0.5, -1}, {1.1, 0}, {0.5, 1}, {-0.5, 1}};
    case 7: return {{0, -0.5}, {0.6, -1.1}, {1.1, -0.6}, {0.5, 0}, {1.1, 0.6}, {0.6, 1.1},
                    {0, 0.5}, {-0.6, 1.1}, {-1.1, 0.6}, {-0.5, 0}, {-1.1, -0.6}, {-0.6, -1.1}};
    case 8: return {{0, -1.4}, {0.35, -0.35}, {1.4, 0}, {0.35, 0.35},
                    {0, 1.4}, {-0.35, 0.35}, {-1.4, 0}, {-0.35, -0.35}};
    case 9: return {{-1.1, -1}, {1.1, 1}, {1.1, -1}, {-1.1, 1}};
    default: return {{-0.4, -1.1}, {0.4, -1.1}, {0.4, -0.4}, {1.1, -0.4}, {1.1, 0.4}, {0.4, 0.4},
                     {0.4, 1.1}, {-0.4, 1.1}, {-0.4, 0.4}, {-1.1, 0.4}, {-1.1, -0.4}, {-0.4, -0.4}};
    }
}

} // namespace

std::string marker(double x, double y, std::size_t shape, std::string_view colour, double size,
                   Filling filling)
{
    const bool full = filling == Filling::full;
    const std::string own(colour);
    const std::string style = "\" fill=\"" + (full ? own : "#fff") + "\" stroke=\"" + (full ? "#fff" : own) +
                              "\" stroke-width=\"" + (full ? "0.80" : "1.40") + "\"/>\n";
    const double half = size / 2;
    const auto circle = [&](double radius, const std::string& with) {
        return "<circle cx=\"" + fixed(x) + "\" cy=\"" + fixed(y) + "\" r=\"" + fixed(radius) + with;
    };
    const std::string middle =
        filling == Filling::dotted ? circle(size / 6, "\" fill=\"" + own + "\"/>\n") : "";
    if (shape == 0)
        return circle(half, style) + middle;
    std::string points;
    for (const auto& [dx, dy] : shape_corners(shape))
        points += fixed(x + half * dx) + "," + fixed(y + half * dy) + " ";
    points.pop_back();
    return "<polygon points=\"" + points + style + middle;
}

} // namespace taut::svg_text
