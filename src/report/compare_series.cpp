// How the variants of a comparison went over time: their looks as CSV and as a diagram.

#include "taut/report/compare.hpp"
#include "taut/runtime/base/csv.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double kLeast = 1e-5; // a volume in single precision is not known better

bool any_look_at_volume(const std::vector<CompareRow>& rows)
{
    return std::any_of(rows.begin(), rows.end(), [](const CompareRow& row) {
        return !row.looks.empty() && row.looks.front().volume.has_value();
    });
}

/// What the diagram shows of a look.
double height(const Look& look, bool volume)
{
    return std::max(volume ? std::abs(1 - look.volume.value_or(1)) : look.max_stretch, kLeast);
}

/// The looks until the first that is no number; that one is named as a gap.
void add_series(Plot& plot, const CompareRow& row, bool volume)
{
    PlotSeries series{row.label, {}};
    for (const Look& look : row.looks)
    {
        if (!std::isfinite(height(look, volume)))
        {
            plot.gaps.push_back(row.label + ": no finite value from " + shown(look.time, 4) + " s on");
            break;
        }
        series.points.push_back({look.time, height(look, volume), ""});
    }
    plot.series.push_back(std::move(series));
}

} // namespace

std::string compare_looks_csv(const std::vector<CompareRow>& rows)
{
    const bool volume = any_look_at_volume(rows);
    std::string text = "variant,frame,time s,largest strain %,active share %,"
                       "linear iterations since the look before";
    text += volume ? ",volume %\n" : "\n";
    for (const CompareRow& row : rows)
        for (const Look& look : row.looks)
        {
            text += csv_cell(row.label) + "," + std::to_string(look.frame) + "," + shown(look.time, 6) + "," +
                    shown(100 * look.max_stretch, 4) + "," +
                    (look.active_share ? shown(100 * *look.active_share, 4) : "") + "," +
                    (look.linear_iterations ? std::to_string(*look.linear_iterations) : "");
            if (volume)
                text += "," + (look.volume ? shown(100 * *look.volume, 7) : "");
            text += "\n";
        }
    return text;
}

Plot compare_series_plot(const std::string& scene, const std::vector<CompareRow>& rows)
{
    const bool volume = any_look_at_volume(rows);
    Plot plot;
    plot.title = (volume ? "Volume error over time: " : "Largest strain over time: ") + scene;
    plot.x_label = "time, s";
    plot.y_label = volume ? "e_V = |V - V0| / V0 of the body furthest from its volume"
                          : "largest (l - L)/L of all springs";
    plot.front = false;
    plot.x_linear = true;
    for (const CompareRow& row : rows)
        if (!row.refusal.empty())
            plot.gaps.push_back(row.label + ": " + row.refusal);
        else if (volume || row.springs)
            add_series(plot, row, volume);
        else
            plot.gaps.push_back(row.label + ": nothing is a spring");
    plot.caption = {"Frames looked at; what is below " + shown(kLeast, 1) + " stands there."};
    return plot;
}

} // namespace taut
