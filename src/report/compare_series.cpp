// How the variants of a comparison went over time: their samples as CSV and as a diagram.

#include "taut/report/compare.hpp"
#include "taut/report/method_settings.hpp"
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
        return !row.series.empty() && row.series.front().volume.has_value();
    });
}

/// What the diagram shows of a sample.
double height(const TimeSample& sample, bool volume)
{
    return std::max(volume ? std::abs(1 - sample.volume.value_or(1)) : sample.max_stretch, kLeast);
}

/// The samples until the first that is no number; that one is named as a gap.
void add_series(Plot& plot, const CompareRow& row, bool volume)
{
    PlotSeries series{row.label, {}};
    for (const TimeSample& sample : row.series)
    {
        if (!std::isfinite(height(sample, volume)))
        {
            plot.gaps.push_back(row.label + ": no finite value from " + shown(sample.time, 4) + " s on");
            break;
        }
        series.points.push_back({sample.time, height(sample, volume), ""});
    }
    series.style = method_style(method_named(row.method));
    add_variant(plot, std::move(series));
}

} // namespace

std::string compare_series_csv(const std::vector<CompareRow>& rows)
{
    const bool volume = any_look_at_volume(rows);
    std::string text = "variant,frame,time s,largest strain %,active share %,"
                       "linear iterations since the look before";
    text += volume ? ",volume %\n" : "\n";
    for (const CompareRow& row : rows)
        for (const TimeSample& sample : row.series)
        {
            text += csv_cell(row.label) + "," + std::to_string(sample.frame) + "," + shown(sample.time, 6) +
                    "," + shown(100 * sample.max_stretch, 4) + "," +
                    (sample.active_share ? shown(100 * *sample.active_share, 4) : "") + "," +
                    (sample.linear_iterations ? std::to_string(*sample.linear_iterations) : "");
            if (volume)
                text += "," + (sample.volume ? shown(100 * *sample.volume, 7) : "");
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
