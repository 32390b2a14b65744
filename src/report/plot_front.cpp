// What of a plot is best, what is off its top, and what has no point.
#include "taut/report/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut {

bool drawable(const PlotPoint& p, bool x_linear)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && (x_linear || p.x > 0) && p.y > 0;
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

std::string gap_table(const Plot& plot)
{
    std::string out;
    for (const std::string& gap : all_gaps(plot))
    {
        std::string row = gap;
        for (std::size_t at = 0; (at = row.find('|', at)) != std::string::npos; at += 2)
            row.insert(at, 1, '\\');
        const std::size_t colon = row.find(": ");
        out +=
            "| " + row.substr(0, colon) + " | " + (colon == row.npos ? "" : row.substr(colon + 2)) + " |\n";
    }
    return out.empty() ? "" : "| without a point | why |\n|---|---|\n" + out;
}

std::vector<FrontPoint> pareto_front(const std::vector<PlotSeries>& series)
{
    std::vector<FrontPoint> all;
    for (std::size_t s = 0; s < series.size(); ++s)
        for (std::size_t p = 0; p < series[s].points.size(); ++p)
            if (drawable(series[s].points[p]))
                all.push_back({s, p});
    const auto at = [&](const FrontPoint& f) {
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

} // namespace taut
