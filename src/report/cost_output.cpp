// A study as JSON, CSV and a diagram.
#include "taut/report/cost.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/number_or_null.hpp"
#include "taut/runtime/base/csv.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/version.hpp"

#include <nlohmann/json.hpp>


namespace taut {
namespace {

using Json = nlohmann::ordered_json;

Json sentence_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// Like %.*g, whatever the locale.
const char* kind_word(const CostStudy& study)
{
    return study.kind == CostKind::at_rest ? "static" : "moving";
}

const char* basis_word(const CostStudy& study)
{
    return study.basis == CostBasis::wall ? "wall" : study.basis == CostBasis::cpu ? "cpu" : "sweeps";
}

Json setting_json(const CostPoint& point)
{
    return {{"method", point.method},
            {"substeps", point.substeps},
            {"iterations", point.iterations},
            {"precision", to_string(point.precision)},
            {"settings", Json::parse(settings_block(point.settings))}};
}

Json point_json(const CostStudy& study, const CostPoint& point)
{
    Json json = setting_json(point);
    const bool gap = !point.error;
    json["error"] = number_or_null(point.error);
    json["error_metric"] = study.metric;
    json["reference"] = study.reference.name;
    json["error_l"] = number_or_null(point.error_l);
    json["error_continuum"] = number_or_null(point.error_continuum);
    json["error_smoothed"] = number_or_null(point.error_smoothed);
    json["contact"] = point.contact ? Json{{"impulse_error", point.contact->impulse},
                                           {"friction_error", point.contact->friction},
                                           {"depth", point.contact->depth}}
                                    : Json(nullptr);
    json["at_reference_floor"] = point.at_floor;
    json["ms_per_simulated_second"] = gap ? Json(nullptr) : Json(point.ms);
    json["ms_least"] = gap ? Json(nullptr) : Json(point.ms_least);
    json["cpu_ms_per_simulated_second"] = gap ? Json(nullptr) : number_or_null(point.cpu_ms);
    json["repetitions"] = point.repetitions;
    json["ms_quartiles"] = gap ? Json(nullptr) : Json({point.ms_low, point.ms_high});
    json["cpu_ms_quartiles"] = gap || !point.cpu_ms ? Json(nullptr) : Json({point.cpu_low, point.cpu_high});
    json["floor"] = point.floor;
    json["sweeps"] = point.sweeps;
    json["simulated_seconds"] = point.simulated_seconds;
    json["pareto"] = point.pareto;
    json["status"] = to_string(point.status);
    json["refused"] = sentence_or_null(point.refused);
    json["other_material"] = sentence_or_null(point.other_material);
    json["reason"] = point.reason;
    return json;
}

Json cheapest_json(const CostStudy& study, const std::vector<CostTarget>& targets)
{
    Json json = Json::object();
    for (const CostTarget& target : targets)
    {
        Json& entry = json[shown(target.tolerance, 6)];
        if (!target.cheapest)
            continue; // null
        const CostPoint& point = study.points[*target.cheapest];
        entry = setting_json(point);
        entry["error"] = *point.error;
        entry["ms_per_simulated_second"] = point.ms;
        entry["sweeps"] = point.sweeps;
        entry["other_material"] = sentence_or_null(point.other_material);
        entry["own_material"] = target.own ? setting_json(study.points[*target.own]) : Json(nullptr);
    }
    return json;
}

Json methods_json(const CostStudy& study)
{
    Json json = Json::object();
    for (const CostMethod& method : study.methods)
    {
        json[method.name] = {{"cheapest", cheapest_json(study, method.targets)}};
        json[method.name]["refused"] = sentence_or_null(method.refused);
    }
    return json;
}

Json reference_json(const CostReference& reference)
{
    return {{"class", reference.name},
            {"text", reference.text},
            {"verified", reference.verified},
            {"error", number_or_null(reference.error)},
            {"error_l", number_or_null(reference.error_l)},
            {"passed_over", reference.passed}};
}

Json continuum_json(const CostStudy& study)
{
    if (!study.continuum)
        return nullptr;
    const ContinuumReference& r = *study.continuum;
    if (!r.reason.empty())
        return {{"class", nullptr}, {"reason", r.reason}};
    return {{"class", "R1"},    {"text", r.text},   {"vertices", r.vertices},
            {"order", r.order}, {"error", r.error}, {"mesh_error", r.mesh_error}};
}

/// Quoted where a comma or quote would break the row.
std::string csv_row(const CostStudy& study, const CostPoint& point)
{
    const auto value = [](const std::optional<double>& v) { return v ? shown(*v, 6) : std::string(); };
    const auto timed = [&](double v) { return point.error ? shown(v, 6) : std::string(); };
    const std::string cells[] = {csv_cell(study.scene),
                                 csv_cell(study.device.executor),
                                 point.method,
                                 std::to_string(point.substeps),
                                 std::to_string(point.iterations),
                                 std::string(to_string(point.precision)),
                                 value(point.error),
                                 study.metric,
                                 csv_cell(study.reference.name),
                                 value(study.reference.error),
                                 value(point.error_l),
                                 value(point.error_smoothed),
                                 timed(point.ms),
                                 timed(point.ms_least),
                                 value(point.error ? point.cpu_ms : std::nullopt),
                                 shown(point.sweeps, 6),
                                 point.pareto ? "1" : "0",
                                 point.at_floor ? "1" : "0",
                                 std::string(to_string(point.status)),
                                 csv_cell(point.reason),
                                 csv_cell(settings_details(point.settings)),
                                 point.refused,
                                 timed(point.ms_low),
                                 timed(point.ms_high),
                                 point.cpu_ms ? timed(point.cpu_low) : "",
                                 point.cpu_ms ? timed(point.cpu_high) : "",
                                 std::to_string(point.repetitions),
                                 point.floor,
                                 point.other_material.empty() ? "0" : "1"};
    std::string row;
    for (const std::string& cell : cells)
        row += (row.empty() ? "" : ",") + cell;
    if (study.has_continuum()) // files of studies without one keep their columns
        row += "," + value(point.error_continuum);
    if (study.contact)
        row += point.contact ? "," + shown(point.contact->impulse, 6) + "," +
                                   shown(point.contact->friction, 6) + "," + shown(point.contact->depth, 6)
                             : ",,,";
    return row + "\n";
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
    json["contact"] = study.contact ? Json{{"impulse", study.contact->impulse},
                                           {"friction", study.contact->friction},
                                           {"depth", study.contact->depth}}
                                    : Json(nullptr);
    json["continuum"] = continuum_json(study);
    json["basis"] = basis_word(study);
    json["rest_tolerance"] = study.kind == CostKind::at_rest ? Json(study.rest_tolerance) : Json(nullptr);
    json["floors"] = Json::array();
    for (const CostFloor& floor : cost_floors(study))
        json["floors"].push_back({{"what", floor.word}, {"error", floor.error}});
    json["points"] = Json::array();
    for (const CostPoint& point : study.points)
        json["points"].push_back(point_json(study, point));
    json["cheapest"] = cheapest_json(study, study.targets);
    json["methods"] = methods_json(study);
    json["sentences"] = cost_sentences(study);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string cost_csv(const CostStudy& study)
{
    std::string out =
        "scene,executor,method,substeps,iterations,precision,error,error_metric,reference,"
        "reference_error,error_l,error_smoothed,ms_per_simulated_second,ms_least,"
        "cpu_ms_per_simulated_second,sweeps,pareto,at_reference_floor,status,reason,details,refused,"
        "ms_quartile_1,ms_quartile_3,cpu_ms_quartile_1,cpu_ms_quartile_3,repetitions,floor,"
        "other_material";
    out += study.has_continuum() ? ",error_continuum" : "";
    out += study.contact ? ",impulse_error,friction_error,contact_depth\n" : "\n";
    for (const CostPoint& point : study.points)
        out += csv_row(study, point);
    return out;
}

} // namespace taut
