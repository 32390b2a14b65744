// Colours: Okabe, Ito, Color Universal Design, 2008 (told apart by colour-blind readers); shapes repeat the
// distinction for prints without colour.
#include "taut/report/svg_plot.hpp"

#include "taut/report/svg_axis.hpp"
#include "taut/report/svg_labels.hpp"
#include "taut/report/svg_text.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

using namespace svg_text;

constexpr double kLeft = 84, kTop = 56, kWide = 560, kHigh = 400; // the plot area, pixels
constexpr AreaBox kBox{kLeft, kTop, kLeft + kWide, kTop + kHigh};
constexpr double kLegend = kLeft + kWide + 24, kPage = 920;
constexpr std::size_t kLegendChars = 30, kLineChars = 128;
constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#555555"};

constexpr std::size_t kMostMarkers = 100;

/// How a series looks: the same in its line, its markers and the legend.
struct Look
{
    Look(const PlotSeries& series, std::size_t index)
        : shape(series.style < 0 ? index : static_cast<std::size_t>(series.style)),
          colour(kColours[shape % kColours.size()]),
          variant(series.style < 0 ? static_cast<int>(index / kColours.size()) : series.variant)
    {}

    /// Attributes of its line.
    std::string dashes() const
    {
        constexpr std::array<const char*, 6> kDashes{"", "7 3", "2 2", "9 3 2 3", "4 4", "12 3 2 3 2 3"};
        const char* dash = kDashes[static_cast<std::size_t>(variant) % kDashes.size()];
        return *dash == 0 ? "" : " stroke-dasharray=\"" + std::string(dash) + "\"";
    }
    std::string mark(double x, double y, double size) const
    {
        constexpr std::array<Filling, 3> kFillings{Filling::full, Filling::hollow, Filling::dotted};
        return marker(x, y, shape, colour, size,
                      kFillings[static_cast<std::size_t>(variant) % kFillings.size()]);
    }

    std::size_t shape;
    std::string colour;
    int variant;
};

/// A floor below this part of the lowest point would only squeeze the points.
constexpr double kFar = 1e-2;

/// Both axes of a plot.
struct Area
{
    explicit Area(const Plot& plot) : linear(plot.x_linear), most(plot.y_most)
    {
        double low[2], high[2];
        std::fill(low, low + 2, std::numeric_limits<double>::infinity());
        std::fill(high, high + 2, -std::numeric_limits<double>::infinity());
        for (const PlotSeries& series : plot.series)
            for (const PlotPoint& p : series.points)
                for (int k = 0; k < 2; ++k)
                    if (drawable(p, linear) && (k == 0 || p.y <= most))
                    {
                        low[k] = std::min(low[k], k == 0 ? p.x : p.y);
                        high[k] = std::max(high[k], k == 0 ? p.x : p.y);
                    }
        for (const PlotFloor& floor : plot.floors)
            if (floor.y > 0 && floor.y < low[1] && (floor.always || floor.y > kFar * low[1]))
                low[1] = floor.y;
        x = axis_of(low[0], high[0], linear, kLeft, kLeft + kWide);
        y = axis_of(low[1], high[1], false, kTop + kHigh, kTop);
    }

    bool holds(const PlotPoint& p) const { return drawable(p, linear) && p.y <= most; }
    bool above(const PlotPoint& p) const { return drawable(p, linear) && p.y > most; }

    bool linear;
    double most;
    Axis x, y;
};

std::string grid(const Area& area)
{
    std::string lines, labels;
    for (const Axis::Tick& t : area.x.ticks())
    {
        lines += line(t.pixel, kTop, t.pixel, kTop + kHigh, t.minor ? "#f1f1f1" : "#d4d4d4", 1);
        labels += t.labelled ? area.x.label(t, t.pixel, kTop + kHigh + 20, "middle") : "";
    }
    for (const Axis::Tick& t : area.y.ticks())
    {
        lines += line(kLeft, t.pixel, kLeft + kWide, t.pixel, t.minor ? "#f1f1f1" : "#d4d4d4", 1);
        labels += t.labelled ? area.y.label(t, kLeft - 8, t.pixel + 4, "end") : "";
    }
    return lines + labels;
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

std::string pixels(const PlotPoint& p, const Area& area)
{
    return fixed(area.x.at(p.x)) + "," + fixed(area.y.at(p.y));
}

/// One mark with its name and spread; above the area an arrow at its upper edge, with the number.
std::string mark(const PlotSeries& series, const PlotPoint& p, const Look& look, const Area& area,
                 double size, const char* opacity = nullptr)
{
    std::string name = series.name + (p.label.empty() ? "" : ", " + p.label);
    std::string shape = look.mark(area.x.at(p.x), area.y.at(p.y), size);
    if (area.above(p))
    {
        const double x = area.x.at(p.x), y = kTop + 1;
        name += ": off the top, " + shown(p.y, 2);
        const std::string low = fixed(y + 9);
        shape = "<polygon points=\"" + fixed(x) + "," + fixed(y) + " " + fixed(x + 5) + "," + low + " " +
                fixed(x - 5) + "," + low + "\" fill=\"#fff\" stroke=\"" + look.colour +
                "\" stroke-width=\"1.40\"/>\n";
    }
    else if (0 < p.x_low && p.x_low < p.x_high)
    {
        const auto inside = [&](double x) { return std::clamp(area.x.at(x), kLeft, kLeft + kWide); };
        shape += line(inside(p.x_low), area.y.at(p.y), inside(p.x_high), area.y.at(p.y), look.colour, 1.2);
    }
    const std::string faint =
        opacity == nullptr ? "" : " fill-opacity=\"" + std::string(opacity) + "\"";
    return "<g" + faint + "><title>" + escaped(name) + "</title>" + shape + "</g>\n";
}

/// All points small, those of its own front large and joined.
std::string draw_own_front(const PlotSeries& series, const Look& look, const Area& area)
{
    std::vector<bool> front(series.points.size(), false);
    std::string points, markers;
    for (const FrontPoint& at : pareto_front({series}))
        if (area.holds(series.points[at.point]))
        {
            front[at.point] = true;
            points += (points.empty() ? "" : " ") + pixels(series.points[at.point], area);
        }
    for (std::size_t i = 0; i < series.points.size(); ++i)
        if (drawable(series.points[i], area.linear))
            markers += mark(series, series.points[i], look, area, front[i] ? 9 : 5, front[i] ? "1" : "0.45");
    return polyline(points, "stroke=\"" + look.colour + "\" stroke-width=\"2.60\"" + look.dashes()) + markers;
}

std::string draw_series(const PlotSeries& series, std::size_t index, const Area& area)
{
    const Look look(series, index);
    if (series.own_front)
        return draw_own_front(series, look, area);
    const bool many = series.points.size() > kMostMarkers;
    const std::string style = "stroke=\"" + look.colour + "\" stroke-width=\"1.20\" stroke-opacity=\"" +
                              (many ? "0.90" : "0.60") + "\"" + look.dashes();
    std::string lines, markers, points;
    for (const PlotPoint& p : series.points)
    {
        if (drawable(p, area.linear) && (!many || area.above(p)))
            markers += mark(series, p, look, area, 8);
        if (!area.holds(p)) // a gap in the line, never a made-up point
        {
            lines += polyline(points, style);
            points.clear();
            continue;
        }
        points += (points.empty() ? "" : " ") + pixels(p, area);
    }
    return lines + polyline(points, style) + markers;
}

std::string draw_front(const Plot& plot, const Area& area, Labels& labels)
{
    std::string points, rings;
    for (const FrontPoint& at : pareto_front(plot.series))
    {
        const PlotPoint& p = plot.series[at.series].points[at.point];
        if (!area.holds(p))
            continue;
        const double px = area.x.at(p.x), py = area.y.at(p.y);
        points += (points.empty() ? "" : " ") + fixed(px) + "," + fixed(py);
        rings += "<circle cx=\"" + fixed(px) + "\" cy=\"" + fixed(py) +
                 "\" r=\"7.00\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.60\"/>\n";
        if (!p.label.empty())
            labels.add(px, py, p.label, "#111");
    }
    return polyline(points, "stroke=\"#111\" stroke-width=\"4.00\" stroke-opacity=\"0.25\"") + rings;
}

/// Notes of series, at their lowest points.
void add_notes(const Plot& plot, const Area& area, Labels& labels)
{
    for (std::size_t i = 0; i < plot.series.size(); ++i)
    {
        const PlotPoint* lowest = nullptr;
        for (const PlotPoint& p : plot.series[i].points)
            if (area.holds(p) && (lowest == nullptr || p.y < lowest->y))
                lowest = &p;
        if (lowest != nullptr && !plot.series[i].note.empty())
            labels.add(area.x.at(lowest->x), area.y.at(lowest->y) + 20, plot.series[i].note,
                       Look(plot.series[i], i).colour.c_str());
    }
}

/// Shaded below each floor; its line has its words at the right edge.
std::string draw_floors(const Plot& plot, const Area& area, Labels& labels)
{
    std::string out;
    for (const PlotFloor& floor : plot.floors)
    {
        const double y = floor.y > 0 ? area.y.at(floor.y) : kTop + kHigh + 1;
        if (!(y >= kTop && y <= kTop + kHigh))
            continue;
        if (floor.of_all)
            out += "<rect x=\"" + fixed(kLeft) + "\" y=\"" + fixed(y) + "\" width=\"" + fixed(kWide) +
                   "\" height=\"" + fixed(kTop + kHigh - y) + "\" fill=\"#888\" fill-opacity=\"0.12\"/>\n";
        out += line(kLeft, y, kLeft + kWide, y, "#777", 1);
        labels.add(kLeft + kWide + 5, y + 4, floor.words, "#555");
    }
    return out;
}

/// `y` is moved below it.
std::string legend(const Plot& plot, double& y)
{
    std::string out;
    y = kTop + 10;
    for (std::size_t i = 0; i < plot.series.size(); ++i)
    {
        const Look look(plot.series[i], i);
        if (!look.dashes().empty())
            out += "<path d=\"M" + fixed(kLegend - 8) + " " + fixed(y - 4) + "h28\" stroke=\"" + look.colour +
                   "\"" + look.dashes() + "/>\n";
        out += look.mark(kLegend + 6, y - 4, 9);
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
        y += 20;
    }
    return out;
}

/// A line for each series that has points above the axis.
std::vector<std::string> all_above(const Plot& plot, const Area& area)
{
    std::vector<std::string> out;
    for (const PlotSeries& series : plot.series)
    {
        std::string words;
        for (const PlotPoint& p : series.points)
            if (area.above(p))
                words += (words.empty() ? ": " : "; ") + (p.label.empty() ? "" : p.label + " at ") +
                         shown(p.y, 2);
        if (!words.empty())
            out.push_back(series.name + words);
    }
    return out;
}

/// Caption, and how much has no point; `y` is moved below them.
std::string footer(const Plot& plot, const Area& area, double& y)
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
    if (const std::vector<std::string> above = all_above(plot, area); !above.empty())
    {
        y += 6;
        lines({"Off the top (above " + shown(plot.y_most, 2) + "):"}, "#222", 0);
        lines(above, "#555", 12);
    }
    if (const std::size_t gaps = all_gaps(plot).size(); gaps > 0)
    {
        y += 6;
        lines({"Without a point: " + std::to_string(gaps) + (gaps == 1 ? " entry" : " entries") +
               " of the table beside this figure."},
              "#a33", 0);
    }
    return out;
}

} // namespace

void add_variant(Plot& plot, PlotSeries series)
{
    series.variant =
        static_cast<int>(std::count_if(plot.series.begin(), plot.series.end(),
                                       [&](const PlotSeries& other) { return other.style == series.style; }));
    plot.series.push_back(std::move(series));
}

std::string svg(const Plot& plot)
{
    const Area area(plot);
    Labels labels(kBox);
    std::string body = draw_floors(plot, area, labels) + grid(area) + frame(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i)
    {
        body += draw_series(plot.series[i], i, area);
        for (const PlotPoint& p : plot.series[i].points)
            if (area.holds(p) && plot.series[i].points.size() <= kMostMarkers)
                labels.keep_off(area.x.at(p.x), area.y.at(p.y), 3);
    }
    if (plot.front)
        body += draw_front(plot, area, labels);
    add_notes(plot, area, labels);
    body += labels.svg();
    double legend_end = 0;
    body += legend(plot, legend_end);
    double bottom = std::max(kTop + kHigh + 74, legend_end + 8);
    body += footer(plot, area, bottom);
    const std::string width = fixed(kPage), height = fixed(bottom + 6);
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
