// A study as a diagram.
#include "taut/report/cost.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <limits>

namespace taut {
namespace {

/// What a time axis shows.
CostBasis time_basis(const CostStudy& study)
{
    return study.basis == CostBasis::cpu ? CostBasis::cpu : CostBasis::wall;
}

bool several(const CostStudy& study) { return study.methods.size() > 1; }

std::string metric_label(const CostStudy& study)
{
    if (study.metric == "e_L")
        return "error e_L, largest distance over the diagonal";
    return study.metric == "e_disp" ? "error e_disp, relative to the displacement at rest"
                                    : "error e_traj, relative to the motion";
}

std::string series_name(const CostStudy& study, const CostPoint& point)
{
    if (several(study))
        return point.method;
    return std::string(to_string(point.precision)) + ", " + std::to_string(point.iterations) +
           (point.iterations == 1 ? " iteration" : " iterations");
}

PlotPoint plot_point(const CostStudy& study, const CostPoint& point, CostAxis axis)
{
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    PlotPoint out;
    out.x = out.y = nothing;
    out.label = std::to_string(point.substeps) + " x " + std::to_string(point.iterations);
    if (const std::string details = settings_details(point.settings); !details.empty())
        out.label += ", " + details;
    out.floor = 10 * study.reference.error.value_or(0);
    if (!point.error)
    {
        out.label += " (" + point.reason + ")";
        return out;
    }
    out.x = axis == CostAxis::sweeps ? point.sweeps : price(point, time_basis(study));
    out.y = *point.error;
    if (axis == CostAxis::time && point.repetitions > 1)
    {
        const bool cpu = time_basis(study) == CostBasis::cpu && point.cpu_ms;
        out.x_low = cpu ? point.cpu_low : point.ms_low;
        out.x_high = cpu ? point.cpu_high : point.ms_high;
    }
    return out;
}

std::vector<std::string> captions(const CostStudy& study, CostAxis axis)
{
    std::vector<std::string> out{"Reference class " + study.reference.name + ". " + study.reference.text};
    for (const std::string& passed : study.reference.passed)
        out.push_back("Passed over: " + passed + ".");
    if (study.has_continuum())
        out.push_back("Continuum R1. " + study.continuum->text +
                      ". Accuracy below the error of the mesh is wasted.");
    const bool at_floor = std::any_of(study.points.begin(), study.points.end(),
                                      [](const CostPoint& point) { return point.at_floor; });
    if (at_floor)
        out.push_back("Errors below " + shown(10 * *study.reference.error, 2) +
                      ", ten times the reference's own, are not told apart.");
    const std::string span =
        study.kind == CostKind::at_rest ? "at rest" : "over " + std::to_string(study.frames) + " frames";
    out.push_back("Errors " + span + "; " + std::to_string(study.vertices) + " vertices, " +
                  std::to_string(study.constraints) + " constraints; " + study.device.name + " (" +
                  study.device.executor + "). " +
                  (several(study) ? "Each line is the front of one method, small marks are its other settings"
                                  : "Lines join settings of more and more substeps") +
                  "; labels are substeps x iterations.");
    if (axis == CostAxis::time)
        out.push_back(
            std::string(time_basis(study) == CostBasis::cpu ? "CPU time" : "Wall time") +
            " of step and wait, median of repetitions in turns with all other settings, after warm-up; bars "
            "from the first to the third quartile.");
    return out;
}

/// "mass_spring, 1, 2, 4 substeps in float: <the first one's reason>": gaps of one method that share a cause.
std::vector<std::string> grouped_gaps(const CostStudy& study)
{
    struct Group
    {
        std::string settings, reason;
        std::size_t count = 0;
    };
    std::vector<std::pair<std::string, Group>> groups;
    for (const CostPoint& point : study.points)
    {
        if (point.error)
            continue;
        const std::string cause =
            !point.refused.empty() ? "R, " + point.refused : std::string(to_string(point.status));
        const std::string key = point.method + " (" + cause + ")";
        auto found =
            std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == key; });
        if (found == groups.end())
            found = groups.insert(found, {key, {"", point.reason, 0}});
        Group& group = found->second;
        group.settings += std::string(group.count++ == 0 ? "" : "; ") + std::to_string(point.substeps) +
                          " x " + std::to_string(point.iterations);
        if (const std::string details = settings_details(point.settings); !details.empty())
            group.settings += " " + details;
    }
    std::vector<std::string> out;
    for (const auto& [key, group] : groups)
        out.push_back(key + ": " + group.settings + (group.count > 1 ? ": the first: " : ": ") +
                      group.reason);
    return out;
}

} // namespace

Plot cost_plot(const CostStudy& study, CostAxis axis)
{
    Plot plot;
    plot.title = "What accuracy costs: " + study.scene +
                 (several(study) || study.methods.empty() ? "" : ", " + study.methods[0].name);
    plot.x_label = axis == CostAxis::sweeps ? "work, sweeps over all constraints per simulated second"
                   : time_basis(study) == CostBasis::cpu ? "CPU time, ms per simulated second"
                                                         : "wall time, ms per simulated second";
    plot.y_label = metric_label(study);
    for (const CostPoint& point : study.points)
    {
        const std::string name = series_name(study, point);
        if (several(study) && !point.error)
            continue; // listed in groups
        if (plot.series.empty() || plot.series.back().name != name)
            plot.series.push_back(
                {name, {}, several(study), "", several(study) ? method_style(method_named(name)) : -1});
        plot.series.back().points.push_back(plot_point(study, point, axis));
    }
    plot.y_most = off_the_top(plot.series, 1); // errors of more than 100 % are of no use to anybody
    plot.floors = plot_floors(study);
    plot.caption = captions(study, axis);
    if (several(study))
        plot.gaps = grouped_gaps(study);
    return plot;
}

} // namespace taut
