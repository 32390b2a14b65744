// Colours: Okabe, Ito, Color Universal Design, 2008 (told apart by colour-blind readers); shapes repeat the
// distinction for prints without colour.
#include "taut/report/svg_plot.hpp"

#include "taut/report/svg_text.hpp"
#include "taut/runtime/base/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

using namespace svg_text;

constexpr double kLeft = 84, kTop = 56, kWide = 560, kHigh = 400; // the plot area, pixels
constexpr double kLegend = kLeft + kWide + 24, kPage = 920;
constexpr std::size_t kLegendChars = 30, kLineChars = 128;
constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#555555"};

bool drawable(const PlotPoint& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y > 0;
}

/// One logarithmic axis: whole decades.
struct Axis
{
    int first = 0, last = 1; // exponents
    double from = 0, to = 1; // pixels of the two ends

    double at(double v) const { return from + (std::log10(v) - first) / (last - first) * (to - from); }
    double at_decade(int e) const { return from + double(e - first) / (last - first) * (to - from); }
    int label_every() const { return std::max(1, (last - first + 9) / 10); }
};

Axis make_axis(const Plot& plot, double PlotPoint::*value, double from, double to)
{
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points)
            if (drawable(p))
            {
                low = std::min(low, p.*value);
                high = std::max(high, p.*value);
            }
    Axis axis{0, 1, from, to};
    if (high > 0)
    {
        axis.first = static_cast<int>(std::floor(std::log10(low)));
        axis.last = std::max(axis.first + 1, static_cast<int>(std::ceil(std::log10(high))));
    }
    return axis;
}

std::string grid(const Axis& x, const Axis& y)
{
    std::string out;
    const auto lines = [&](const Axis& axis, bool upright, int decade)
    {
        const auto one = [&](double at, const char* colour)
        {
            out += upright ? line(at, kTop, at, kTop + kHigh, colour, 1)
                           : line(kLeft, at, kLeft + kWide, at, colour, 1);
        };
        if (decade < axis.last && axis.last - axis.first <= 6)
            for (int k = 2; k < 10; ++k)
                one(axis.at(k * std::pow(10.0, decade)), "#f1f1f1");
        one(axis.at_decade(decade), "#d4d4d4");
    };
    for (int d = x.first; d <= x.last; ++d)
        lines(x, true, d);
    for (int d = y.first; d <= y.last; ++d)
        lines(y, false, d);
    for (int d = x.first; d <= x.last; d += x.label_every())
        out += power_of_ten(x.at_decade(d), kTop + kHigh + 20, d, {.size = 12, .anchor = "middle"});
    for (int d = y.first; d <= y.last; d += y.label_every())
        out += power_of_ten(kLeft - 8, y.at_decade(d) + 4, d, {.size = 12, .anchor = "end"});
    return out;
}

std::string frame(const Plot& plot)
{
    std::string out = "<rect x=\"" + fixed(kLeft) + "\" y=\"" + fixed(kTop) + "\" width=\"" + fixed(kWide) +
                      "\" height=\"" + fixed(kHigh) + "\" fill=\"none\" stroke=\"#222\"/>\n";
    out += text(kLeft, 30, plot.title, {.size = 17, .bold = true});
    out += text(kLeft + kWide / 2, kTop + kHigh + 44, plot.x_label, {.size = 13, .anchor = "middle"});
    out += text(26, kTop + kHigh / 2, plot.y_label, {.size = 13, .anchor = "middle", .turn = -90});
    return out;
}

std::string polyline(const std::string& points, const std::string& style)
{
    if (points.find(' ') == std::string::npos) // a line needs two points
        return "";
    return "<polyline points=\"" + points + "\" fill=\"none\" " + style + "/>\n";
}

std::string pixels(const PlotPoint& p, const Axis& x, const Axis& y)
{
    return fixed(x.at(p.x)) + "," + fixed(y.at(p.y));
}

/// All points small, those of its own front large and joined.
std::string draw_own_front(const PlotSeries& series, std::size_t index, const Axis& x, const Axis& y)
{
    const std::string colour = kColours[index % kColours.size()];
    std::vector<bool> front(series.points.size(), false);
    std::string points, markers;
    for (const FrontPoint& at : pareto_front({series}))
    {
        front[at.point] = true;
        points += (points.empty() ? "" : " ") + pixels(series.points[at.point], x, y);
    }
    for (std::size_t i = 0; i < series.points.size(); ++i)
    {
        const PlotPoint& p = series.points[i];
        if (!drawable(p))
            continue;
        const std::string name = series.name + (p.label.empty() ? "" : ", " + p.label);
        const char* opacity = front[i] ? "1" : "0.45";
        markers += "<g fill-opacity=\"" + std::string(opacity) + "\"><title>" + escaped(name) + "</title>" +
                   marker(x.at(p.x), y.at(p.y), index, colour, front[i] ? 9 : 5) + "</g>\n";
    }
    return polyline(points, "stroke=\"" + colour + "\" stroke-width=\"2.60\"") + markers;
}

std::string draw_series(const PlotSeries& series, std::size_t index, const Axis& x, const Axis& y)
{
    if (series.own_front)
        return draw_own_front(series, index, x, y);
    const std::string colour = kColours[index % kColours.size()];
    const std::string style = "stroke=\"" + colour + "\" stroke-width=\"1.20\" stroke-opacity=\"0.60\"";
    std::string lines, markers, points;
    for (const PlotPoint& p : series.points)
    {
        if (!drawable(p)) // a gap in the line, never a made-up point
        {
            lines += polyline(points, style);
            points.clear();
            continue;
        }
        points += (points.empty() ? "" : " ") + pixels(p, x, y);
        const std::string name = series.name + (p.label.empty() ? "" : ", " + p.label);
        markers += "<g><title>" + escaped(name) + "</title>" +
                   marker(x.at(p.x), y.at(p.y), index, colour, 8) + "</g>\n";
    }
    return lines + polyline(points, style) + markers;
}

std::string draw_front(const Plot& plot, const Axis& x, const Axis& y)
{
    std::string points, rings, labels;
    double label_x = -1e9, label_y = -1e9;
    for (const FrontPoint& at : pareto_front(plot.series))
    {
        const PlotPoint& p = plot.series[at.series].points[at.point];
        const double px = x.at(p.x), py = y.at(p.y);
        points += (points.empty() ? "" : " ") + fixed(px) + "," + fixed(py);
        rings += "<circle cx=\"" + fixed(px) + "\" cy=\"" + fixed(py) +
                 "\" r=\"7.00\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.60\"/>\n";
        const bool crowded = std::abs(px - label_x) < 60 && std::abs(py - label_y) < 12;
        if (p.label.empty() || crowded)
            continue;
        const bool right = px < kLeft + 0.8 * kWide; // towards the inside
        labels += text(px + (right ? 9 : -9), py - 8, p.label,
                       {.size = 10, .anchor = right ? "start" : "end", .fill = "#111"});
        label_x = px;
        label_y = py;
    }
    return polyline(points, "stroke=\"#111\" stroke-width=\"4.00\" stroke-opacity=\"0.25\"") + rings + labels;
}

std::string legend(const Plot& plot)
{
    std::string out;
    double y = kTop + 10;
    for (std::size_t i = 0; i < plot.series.size(); ++i)
    {
        out += marker(kLegend + 6, y - 4, i, kColours[i % kColours.size()], 9);
        for (const std::string& words : wrapped(plot.series[i].name, kLegendChars))
        {
            out += text(kLegend + 20, y, words);
            y += 16;
        }
        y += 4;
    }
    if (plot.front)
    {
        out += "<circle cx=\"" + fixed(kLegend + 6) + "\" cy=\"" + fixed(y - 4) +
               "\" r=\"6.00\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.60\"/>\n";
        out += text(kLegend + 20, y, "front: nothing is better in both");
    }
    return out;
}

std::vector<std::string> all_gaps(const Plot& plot)
{
    std::vector<std::string> out = plot.gaps;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points)
            if (!drawable(p))
                out.push_back(series.name + (p.label.empty() ? "" : ", " + p.label) +
                              ": no finite positive value to draw");
    return out;
}

/// Caption and gaps; `y` is moved below them.
std::string footer(const Plot& plot, double& y)
{
    std::string out;
    const auto lines = [&](const std::vector<std::string>& all, const char* fill, double indent)
    {
        for (const std::string& entry : all)
            for (const std::string& words : wrapped(entry, kLineChars))
            {
                out += text(kLeft + indent, y, words, {.size = 12, .fill = fill});
                y += 17;
            }
    };
    lines(plot.caption, "#222", 0);
    if (const std::vector<std::string> gaps = all_gaps(plot); !gaps.empty())
    {
        y += 6;
        lines({"Without a point:"}, "#222", 0);
        lines(gaps, "#a33", 12);
    }
    return out;
}

} // namespace

std::vector<FrontPoint> pareto_front(const std::vector<PlotSeries>& series)
{
    std::vector<FrontPoint> all;
    for (std::size_t s = 0; s < series.size(); ++s)
        for (std::size_t p = 0; p < series[s].points.size(); ++p)
            if (drawable(series[s].points[p]))
                all.push_back({s, p});
    const auto at = [&](const FrontPoint& f)
    {
        const PlotPoint& p = series[f.series].points[f.point];
        return std::pair(p.x, std::max(p.y, p.floor));
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const FrontPoint& a, const FrontPoint& b) { return at(a) < at(b); });
    std::vector<FrontPoint> out;
    for (const FrontPoint& f : all)
        if (out.empty() || at(f).second < at(out.back()).second || at(f) == at(out.back()))
            out.push_back(f);
    return out;
}

std::string svg(const Plot& plot)
{
    const Axis x = make_axis(plot, &PlotPoint::x, kLeft, kLeft + kWide);
    const Axis y = make_axis(plot, &PlotPoint::y, kTop + kHigh, kTop);
    std::string body = grid(x, y) + frame(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        body += draw_series(plot.series[i], i, x, y);
    if (plot.front)
        body += draw_front(plot, x, y);
    body += legend(plot);
    double bottom = kTop + kHigh + 74;
    body += footer(plot, bottom);
    const double legend_end = kTop + 36.0 * static_cast<double>(plot.series.size() + 1);
    const std::string width = fixed(kPage), height = fixed(std::max(bottom + 6, legend_end));
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
           width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
           "\" font-family=\"Helvetica, Arial, sans-serif\">\n" +
           "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + body + "</svg>\n";
}

void write_svg(const std::filesystem::path& file, const Plot& plot)
{
    write_file(file, svg(plot));
}

} // namespace taut
