// Colours: Okabe, Ito, Color Universal Design, 2008 (told apart by colour-blind readers); shapes repeat the
// distinction for prints without colour.
#include "taut/report/svg_series.hpp"

#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace taut::svg_text {
namespace {

constexpr std::array<const char*, kShapes> kSeriesColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                             "#e69f00", "#56b4e9", "#555555"};
constexpr std::array<Filling, 3> kSeriesFillings{Filling::full, Filling::hollow, Filling::dotted};

/// Variants beyond the fillings of a shape have a shape that no style has.
std::size_t series_shape(std::size_t style, std::size_t variant)
{
    const std::size_t round = variant / kSeriesFillings.size();
    return round == 0 ? style % kShapes : kShapes + (round - 1) % kMoreShapes;
}

/// Of more points than these not every one has a marker: they would cover each other and the dashes.
constexpr std::size_t kMostMarked = 50;

/// Which points of a series have a marker.
class SparseMarks
{
public:
    /// Series that lie on each other have theirs at different places.
    SparseMarks(const PlotSeries& series, std::size_t index, bool over_time)
        : all_(series.points.size() <= kMostMarked),
          over_time_(over_time),
          way_(kGap * static_cast<double>(kPhases - index % kPhases) / kPhases)
    {}

    /// Of the points in their order. Over time what goes up and down steeply is no longer way.
    bool next(double x, double y)
    {
        if (any_)
            way_ += over_time_ ? std::abs(x - x_) : std::hypot(x - x_, y - y_);
        any_ = true;
        x_ = x;
        y_ = y;
        if (!all_ && way_ < kGap - 0.01)
            return false;
        way_ = 0;
        return true;
    }

private:
    static constexpr std::size_t kPhases = 4;
    static constexpr double kGap = 36; // pixels
    bool all_, over_time_, any_ = false;
    double way_, x_ = 0, y_ = 0; // since the last marker; the last point
};

/// One mark with its name and spread; above the area an arrow at its upper edge, with the number.
std::string draw_mark(const PlotSeries& series, const PlotPoint& p, const Look& look, const Area& area,
                      double size, Labels& labels, const char* opacity = nullptr)
{
    const double x = area.x.at(p.x), y = area.y.at(p.y);
    std::string name = series.name + (p.label.empty() ? "" : ", " + p.label);
    std::string shape = look.mark(x, y, size);
    if (area.above(p))
    {
        constexpr double kTip = kTop + 1;
        name += ": off the top, " + shown(p.y, 2);
        const std::string low = fixed(kTip + 9);
        shape = "<polygon points=\"" + fixed(x) + "," + fixed(kTip) + " " + fixed(x + 5) + "," + low + " " +
                fixed(x - 5) + "," + low + "\" fill=\"#fff\" stroke=\"" + look.colour +
                "\" stroke-width=\"1.40\"/>\n";
        labels.keep_off(x, kTip + 4.5, 5);
    }
    else
    {
        labels.keep_off(x, y, std::min(size / 2, 4.0));
        if (0 < p.x_low && p.x_low < p.x_high)
        {
            const auto inside = [&](double at) { return std::clamp(area.x.at(at), kLeft, kLeft + kWide); };
            const double low = inside(p.x_low), high = inside(p.x_high);
            shape += line(low, y, high, y, look.colour, 1.2);
            labels.keep_off({{low, y}, {high, y}});
        }
    }
    const std::string faint = opacity == nullptr ? "" : " fill-opacity=\"" + std::string(opacity) + "\"";
    return "<g" + faint + "><title>" + escaped(name) + "</title>" + shape + "</g>\n";
}

/// All points small, those of its own front large and joined.
std::string draw_own_front(const PlotSeries& series, const Look& look, const Area& area, Labels& labels)
{
    std::vector<bool> front(series.points.size(), false);
    Path path;
    std::string markers;
    for (const FrontPoint& at : pareto_front({series}))
        if (const PlotPoint& p = series.points[at.point]; area.holds(p))
        {
            front[at.point] = true;
            path.emplace_back(area.x.at(p.x), area.y.at(p.y));
        }
    for (std::size_t i = 0; i < series.points.size(); ++i)
        if (drawable(series.points[i], area.linear))
            markers += draw_mark(series, series.points[i], look, area, front[i] ? 9 : 5, labels,
                                 front[i] ? "1" : "0.45");
    labels.keep_off(path);
    return polyline(path, "stroke=\"" + look.colour + "\" stroke-width=\"2.60\"" + look.dashes()) + markers;
}

} // namespace

Look::Look(const PlotSeries& series, std::size_t index)
{
    const bool by_place = series.style < 0;
    const std::size_t style = by_place ? index : static_cast<std::size_t>(series.style);
    variant = by_place ? index / kShapes : static_cast<std::size_t>(series.variant);
    shape = series_shape(style, variant);
    colour = kSeriesColours[style % kSeriesColours.size()];
}

std::string Look::dashes() const
{
    constexpr std::array<const char*, 6> kDashes{"", "7 3", "2 2", "9 3 2 3", "4 4", "12 3 2 3 2 3"};
    const char* dash = kDashes[variant % kDashes.size()];
    return *dash == 0 ? "" : " stroke-dasharray=\"" + std::string(dash) + "\"";
}

std::string Look::mark(double x, double y, double size) const
{
    return marker(x, y, shape, colour, size, kSeriesFillings[variant % kSeriesFillings.size()]);
}

std::string draw_series(const PlotSeries& series, std::size_t index, const Area& area, Labels& labels)
{
    const Look look(series, index);
    if (series.own_front)
        return draw_own_front(series, look, area, labels);
    const bool dense = series.points.size() > kMostMarked;
    const std::string style = "stroke=\"" + look.colour + "\" stroke-width=\"1.20\" stroke-opacity=\"" +
                              (dense ? "0.90" : "0.60") + "\"" + look.dashes();
    std::string lines, markers;
    Path path;
    const auto end_line = [&] {
        lines += polyline(path, style);
        labels.keep_off(path);
        path.clear();
    };
    SparseMarks marked(series, index, area.linear);
    for (const PlotPoint& p : series.points)
    {
        if (drawable(p, area.linear) && (area.above(p) || marked.next(area.x.at(p.x), area.y.at(p.y))))
            markers += draw_mark(series, p, look, area, 8, labels);
        if (area.holds(p))
            path.emplace_back(area.x.at(p.x), area.y.at(p.y));
        else // a gap in the line, never a made-up point
            end_line();
    }
    end_line();
    return lines + markers;
}

} // namespace taut::svg_text
