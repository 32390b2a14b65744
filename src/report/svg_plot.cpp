// Colours: Okabe, Ito, Color Universal Design, 2008 (told apart by colour-blind readers); shapes repeat the
// distinction for prints without colour.
#include "taut/report/svg_plot.hpp"

#include "taut/report/svg_axis.hpp"
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
constexpr double kLegend = kLeft + kWide + 24, kPage = 920;
constexpr std::size_t kLegendChars = 30, kLineChars = 128;
constexpr std::array<const char*, 7> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#555555"};

constexpr std::size_t kMostMarkers = 100;

bool drawable(const PlotPoint& p, bool x_linear = false)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && (x_linear || p.x > 0) && p.y > 0;
}

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

/// One mark with its name; above the area an arrow at its upper edge, with the number.
std::string mark(const PlotSeries& series, const PlotPoint& p, std::size_t index, const Area& area,
                 double size, const char* opacity = nullptr)
{
    const std::string colour = kColours[index % kColours.size()];
    std::string name = series.name + (p.label.empty() ? "" : ", " + p.label);
    std::string shape = marker(area.x.at(p.x), area.y.at(p.y), index, colour, size);
    if (area.above(p))
    {
        const double x = area.x.at(p.x), y = kTop + 1;
        name += ": off the top, " + shown(p.y, 2);
        const std::string low = fixed(y + 9);
        shape = "<polygon points=\"" + fixed(x) + "," + fixed(y) + " " + fixed(x + 5) + "," + low + " " +
                fixed(x - 5) + "," + low + "\" fill=\"#fff\" stroke=\"" + colour +
                "\" stroke-width=\"1.40\"/>\n";
    }
    const std::string faint =
        opacity == nullptr ? "" : " fill-opacity=\"" + std::string(opacity) + "\"";
    return "<g" + faint + "><title>" + escaped(name) + "</title>" + shape + "</g>\n";
}

/// All points small, those of its own front large and joined.
std::string draw_own_front(const PlotSeries& series, std::size_t index, const Area& area)
{
    const std::string colour = kColours[index % kColours.size()];
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
            markers += mark(series, series.points[i], index, area, front[i] ? 9 : 5, front[i] ? "1" : "0.45");
    return polyline(points, "stroke=\"" + colour + "\" stroke-width=\"2.60\"") + markers;
}

std::string draw_series(const PlotSeries& series, std::size_t index, const Area& area)
{
    if (series.own_front)
        return draw_own_front(series, index, area);
    const std::string colour = kColours[index % kColours.size()];
    const bool many = series.points.size() > kMostMarkers;
    const std::string style = "stroke=\"" + colour + "\" stroke-width=\"1.20\" stroke-opacity=\"" +
                              (many ? "0.90" : "0.60") + "\"";
    std::string lines, markers, points;
    for (const PlotPoint& p : series.points)
    {
        if (drawable(p, area.linear) && (!many || area.above(p)))
            markers += mark(series, p, index, area, 8);
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

/// Writes labels beside points where none stands yet.
class Labels
{
public:
    /// Tries right, left, below on the right and on the left, in that order (or left first); gives up else.
    void add(double x, double y, const std::string& words, const char* fill)
    {
        constexpr double kChar = 5.4, kHeight = 11; // of text of size 10
        const double width = kChar * static_cast<double>(words.size());
        const bool right_first = x < kLeft + 0.8 * kWide;
        for (const double dy : {-8.0, 16.0})
            for (const bool right : {right_first, !right_first})
            {
                const double left = right ? x + 9 : x - 9 - width, base = y + dy;
                const Box box{left, base - kHeight, left + width, base};
                const bool inside = box.left > kLeft && box.right < kLeft + kWide && box.top > kTop &&
                                    box.bottom < kTop + kHigh;
                if (!inside || std::any_of(taken_.begin(), taken_.end(),
                                           [&](const Box& other) { return other.meets(box); }))
                    continue;
                taken_.push_back(box);
                text_ += text(right ? x + 9 : x - 9, base, words,
                              {.size = 10, .anchor = right ? "start" : "end", .fill = fill});
                return;
            }
    }
    const std::string& svg() const { return text_; }

private:
    struct Box
    {
        double left, top, right, bottom;
        bool meets(const Box& o) const
        {
            return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
        }
    };
    std::vector<Box> taken_;
    std::string text_;
};

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
                       kColours[i % kColours.size()]);
    }
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
            if (!drawable(p, plot.x_linear))
                out.push_back(series.name + (p.label.empty() ? "" : ", " + p.label) +
                              ": no finite positive value to draw");
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

/// Caption and gaps; `y` is moved below them.
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

double off_the_top(const std::vector<PlotSeries>& series, double useful)
{
    constexpr double kTimes = 10;
    double largest = 0;
    for (const PlotSeries& one : series)
        for (const PlotPoint& p : one.points)
            if (drawable(p) && p.y <= useful)
                largest = std::max(largest, p.y);
    return largest > 0 ? kTimes * largest : std::numeric_limits<double>::infinity();
}

std::string svg(const Plot& plot)
{
    const Area area(plot);
    std::string body = grid(area) + frame(plot);
    for (std::size_t i = 0; i < plot.series.size(); ++i)
        body += draw_series(plot.series[i], i, area);
    Labels labels;
    if (plot.front)
        body += draw_front(plot, area, labels);
    add_notes(plot, area, labels);
    body += labels.svg();
    body += legend(plot);
    double bottom = kTop + kHigh + 74;
    body += footer(plot, area, bottom);
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
