#include "taut/report/svg_plot.hpp"

#include "taut/report/svg_area.hpp"
#include "taut/report/svg_labels.hpp"
#include "taut/report/svg_series.hpp"
#include "taut/report/svg_text.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace taut {
namespace {

using namespace svg_text;

constexpr AreaBox kBox{kLeft, kTop, kLeft + kWide, kTop + kHigh};
constexpr double kLegend = kLeft + kWide + 24, kPage = 920;
constexpr std::size_t kLegendChars = 30, kLineChars = 128;

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

std::string draw_front(const Plot& plot, const Area& area, Labels& labels)
{
    constexpr double kRing = 7;
    struct Named
    {
        double x, y;
        const std::string& words;
    };
    Path path;
    std::vector<Named> names;
    std::string rings;
    for (const FrontPoint& at : pareto_front(plot.series))
    {
        const PlotPoint& p = plot.series[at.series].points[at.point];
        if (!area.holds(p))
            continue;
        const double x = area.x.at(p.x), y = area.y.at(p.y);
        path.emplace_back(x, y);
        rings += "<circle cx=\"" + fixed(x) + "\" cy=\"" + fixed(y) + "\" r=\"" + fixed(kRing) +
                 "\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.60\"/>\n";
        labels.keep_off(x, y, kRing - 1);
        if (!p.label.empty())
            names.push_back({x, y, p.label});
    }
    labels.keep_off(path);
    for (const Named& name : names) // no label stands on a later ring
        labels.add(name.x, name.y, name.words, "#111");
    return polyline(path, "stroke=\"#111\" stroke-width=\"4.00\" stroke-opacity=\"0.25\"") + rings;
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

/// Where a floor stands; empty outside the area.
std::optional<double> height(const PlotFloor& floor, const Area& area)
{
    const double y = floor.y > 0 ? area.y.at(floor.y) : kTop + kHigh + 1;
    return y >= kTop && y <= kTop + kHigh ? std::optional(y) : std::nullopt;
}

std::string shades(const Plot& plot, const Area& area)
{
    std::string out;
    for (const PlotFloor& floor : plot.floors)
        if (const auto y = height(floor, area); y && floor.of_all)
            out += "<rect x=\"" + fixed(kLeft) + "\" y=\"" + fixed(*y) + "\" width=\"" + fixed(kWide) +
                   "\" height=\"" + fixed(kTop + kHigh - *y) + "\" fill=\"#888\" fill-opacity=\"0.12\"/>\n";
    return out;
}

std::string floor_lines(const Plot& plot, const Area& area, Labels& labels)
{
    std::string out;
    for (const PlotFloor& floor : plot.floors)
        if (const auto y = height(floor, area))
        {
            out += line(kLeft, *y, kLeft + kWide, *y, "#777", 1);
            labels.keep_off({{kLeft, *y}, {kLeft + kWide, *y}});
        }
    return out;
}

void add_floors(const Plot& plot, const Area& area, Labels& labels)
{
    for (const PlotFloor& floor : plot.floors)
        if (const auto y = height(floor, area))
            labels.add_along(*y, floor.words, "#555");
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
    // The grid lies on the shades, and lines of floors on the grid: a floor at a decade is seen.
    std::string body = shades(plot, area) + grid(area) + floor_lines(plot, area, labels) + frame(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        body += draw_series(plot.series[i], i, area, labels);
    if (plot.front)
        body += draw_front(plot, area, labels);
    add_notes(plot, area, labels);
    add_floors(plot, area, labels);
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
