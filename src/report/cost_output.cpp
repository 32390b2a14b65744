// A study as JSON, CSV and a diagram.
#include "taut/report/cost.hpp"

#include "taut/version.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace taut {
namespace {

using Json = nlohmann::ordered_json;

Json maybe(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// Like %.*g, whatever the locale.
std::string number(double value, int digits = 6)
{
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
    return std::string(text, end);
}

const char* kind_word(const CostStudy& study)
{
    return study.kind == CostKind::at_rest ? "static" : "moving";
}

Json setting_json(const CostPoint& point)
{
    return {{"method", point.method},
            {"substeps", point.substeps},
            {"iterations", point.iterations},
            {"precision", to_string(point.precision)}};
}

Json point_json(const CostStudy& study, const CostPoint& point)
{
    Json json = setting_json(point);
    const bool gap = !point.error;
    json["error"] = maybe(point.error);
    json["error_metric"] = study.metric;
    json["reference"] = study.reference.name;
    json["error_l"] = maybe(point.error_l);
    json["error_smoothed"] = maybe(point.error_smoothed);
    json["at_reference_floor"] = point.at_floor;
    json["ms_per_simulated_second"] = gap ? Json(nullptr) : Json(point.ms);
    json["ms_least"] = gap ? Json(nullptr) : Json(point.ms_least);
    json["cpu_ms_per_simulated_second"] = gap ? Json(nullptr) : maybe(point.cpu_ms);
    json["repetitions"] = point.repetitions;
    json["sweeps"] = point.sweeps;
    json["simulated_seconds"] = point.simulated_seconds;
    json["pareto"] = point.pareto;
    json["status"] = to_string(point.status);
    json["reason"] = point.reason;
    return json;
}

Json cheapest_json(const CostStudy& study)
{
    Json json = Json::object();
    for (const CostTarget& target : study.targets)
    {
        Json& entry = json[number(target.tolerance)];
        if (!target.cheapest)
            continue; // null
        const CostPoint& point = study.points[*target.cheapest];
        entry = setting_json(point);
        entry["error"] = *point.error;
        entry["ms_per_simulated_second"] = point.ms;
        entry["sweeps"] = point.sweeps;
    }
    return json;
}

Json reference_json(const CostReference& reference)
{
    return {{"class", reference.name},
            {"text", reference.text},
            {"verified", reference.verified},
            {"error", maybe(reference.error)},
            {"error_l", maybe(reference.error_l)},
            {"passed_over", reference.passed}};
}

/// Quoted where a comma or quote would break the row.
std::string field(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

std::string csv_row(const CostStudy& study, const CostPoint& point)
{
    const auto value = [](const std::optional<double>& v) { return v ? number(*v) : std::string(); };
    const auto timed = [&](double v) { return point.error ? number(v) : std::string(); };
    const std::string cells[] = {field(study.scene),
                                 field(study.device.executor),
                                 point.method,
                                 std::to_string(point.substeps),
                                 std::to_string(point.iterations),
                                 std::string(to_string(point.precision)),
                                 value(point.error),
                                 study.metric,
                                 field(study.reference.name),
                                 value(study.reference.error),
                                 value(point.error_l),
                                 value(point.error_smoothed),
                                 timed(point.ms),
                                 timed(point.ms_least),
                                 value(point.error ? point.cpu_ms : std::nullopt),
                                 number(point.sweeps),
                                 point.pareto ? "1" : "0",
                                 point.at_floor ? "1" : "0",
                                 std::string(to_string(point.status)),
                                 field(point.reason)};
    std::string row;
    for (const std::string& cell : cells)
        row += (row.empty() ? "" : ",") + cell;
    return row + "\n";
}

std::string metric_label(const CostStudy& study)
{
    if (study.metric == "e_L")
        return "error e_L, largest distance over the diagonal";
    return study.metric == "e_disp" ? "error e_disp, relative to the displacement at rest"
                                    : "error e_traj, relative to the motion";
}

std::string series_name(const CostPoint& point)
{
    return std::string(to_string(point.precision)) + ", " + std::to_string(point.iterations) +
           (point.iterations == 1 ? " iteration" : " iterations");
}

PlotPoint plot_point(const CostPoint& point, CostAxis axis, double floor)
{
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    PlotPoint out;
    out.x = out.y = nothing;
    out.label = std::to_string(point.substeps) + " x " + std::to_string(point.iterations);
    out.floor = floor;
    if (!point.error)
    {
        out.label += " (" + point.reason + ")";
        return out;
    }
    out.x = axis == CostAxis::time ? point.ms : point.sweeps;
    out.y = *point.error;
    return out;
}

std::vector<std::string> captions(const CostStudy& study, CostAxis axis)
{
    std::vector<std::string> out{"Reference class " + study.reference.name + ". " + study.reference.text};
    for (const std::string& passed : study.reference.passed)
        out.push_back("Passed over: " + passed + ".");
    const bool at_floor = std::any_of(study.points.begin(), study.points.end(),
                                      [](const CostPoint& point) { return point.at_floor; });
    if (at_floor)
        out.push_back("Errors below " + number(10 * *study.reference.error, 2) +
                      ", ten times the reference's own, are not told apart.");
    const std::string span =
        study.kind == CostKind::at_rest ? "at rest" : "over " + std::to_string(study.frames) + " frames";
    out.push_back("Errors " + span + "; " + std::to_string(study.vertices) + " vertices, " +
                  std::to_string(study.constraints) + " constraints; " + study.device.name + " (" +
                  study.device.executor +
                  "). Lines join settings of more and more substeps; labels are substeps x iterations.");
    if (axis == CostAxis::time)
        out.push_back("Wall time of step and wait, median of repetitions after warm-up.");
    return out;
}

} // namespace

std::string cost_json(const CostStudy& study)
{
    Json json = {{"taut", TAUT_VERSION}, {"scene", study.scene}};
    json["device"] = study.device.name;
    json["executor"] = study.device.executor;
    json["driver"] = study.device.driver;
    json["kind"] = kind_word(study);
    json["error_metric"] = study.metric;
    json["frames"] = study.frames;
    json["timestep"] = study.timestep;
    json["vertices"] = study.vertices;
    json["constraints"] = study.constraints;
    json["status"] = to_string(study.interrupted ? Status::interrupted : Status::completed);
    json["reference"] = reference_json(study.reference);
    json["points"] = Json::array();
    for (const CostPoint& point : study.points)
        json["points"].push_back(point_json(study, point));
    json["cheapest"] = cheapest_json(study);
    json["sentences"] = cost_sentences(study);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string cost_csv(const CostStudy& study)
{
    std::string out = "scene,executor,method,substeps,iterations,precision,error,error_metric,reference,"
                      "reference_error,error_l,error_smoothed,ms_per_simulated_second,ms_least,"
                      "cpu_ms_per_simulated_second,sweeps,pareto,at_reference_floor,status,reason\n";
    for (const CostPoint& point : study.points)
        out += csv_row(study, point);
    return out;
}

Plot cost_plot(const CostStudy& study, CostAxis axis)
{
    Plot plot;
    plot.title = "What accuracy costs: " + study.scene + ", xpbd";
    plot.x_label = axis == CostAxis::time ? "wall time, ms per simulated second"
                                          : "work, sweeps over all constraints per simulated second";
    plot.y_label = metric_label(study);
    for (const CostPoint& point : study.points)
    {
        if (plot.series.empty() || plot.series.back().name != series_name(point))
            plot.series.push_back({series_name(point), {}});
        plot.series.back().points.push_back(plot_point(point, axis, 10 * study.reference.error.value_or(0)));
    }
    plot.caption = captions(study, axis);
    return plot;
}

} // namespace taut
